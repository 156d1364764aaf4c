# SPDX-License-Identifier: GPL-3.0-or-later
"""A PNG reader for tests: 8-bit grey, grey-alpha, RGB, RGBA or palette, not interlaced; nothing but the standard library."""

import struct
import zlib

CHANNELS = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}


def chunks(data):
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise ValueError("not a PNG file")
    at = 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + length]
        (crc,) = struct.unpack(">I", data[at + 8 + length : at + 12 + length])
        if crc != zlib.crc32(kind + body):
            raise ValueError("bad checksum in " + kind.decode("ascii", "replace"))
        yield kind, body
        at += 12 + length


def unfilter(kind, row, previous, step):
    if kind == 1:
        for i in range(step, len(row)):
            row[i] = (row[i] + row[i - step]) & 255
    elif kind == 2:
        for i, up in enumerate(previous):
            row[i] = (row[i] + up) & 255
    elif kind == 3:
        for i, up in enumerate(previous):
            left = row[i - step] if i >= step else 0
            row[i] = (row[i] + (left + up) // 2) & 255
    elif kind == 4:
        for i, up in enumerate(previous):
            left = row[i - step] if i >= step else 0
            corner = previous[i - step] if i >= step else 0
            estimate = left + up - corner
            dl, du, dc = abs(estimate - left), abs(estimate - up), abs(estimate - corner)
            row[i] = (row[i] + (left if dl <= du and dl <= dc else up if du <= dc else corner)) & 255
    elif kind != 0:
        raise ValueError(f"unknown row filter {kind}")


def to_rgba(row, colour, palette, alphas):
    if colour == 6:
        return bytes(row)
    out = bytearray()
    if colour == 2:
        for i in range(0, len(row), 3):
            out += row[i : i + 3] + b"\xff"
    elif colour == 0:
        for value in row:
            out += bytes((value, value, value, 255))
    elif colour == 4:
        for i in range(0, len(row), 2):
            out += bytes((row[i], row[i], row[i], row[i + 1]))
    else:
        for index in row:
            alpha = alphas[index] if index < len(alphas) else 255
            out += palette[3 * index : 3 * index + 3] + bytes((alpha,))
    return bytes(out)


def unpack(row, depth, width):
    """Samples of less than 8 bits (palettes), one byte each."""
    if depth == 8:
        return row
    per_byte = 8 // depth
    mask = (1 << depth) - 1
    return bytearray((row[i // per_byte] >> (8 - depth * (i % per_byte + 1))) & mask for i in range(width))


def read(path):
    """(width, height, straight RGBA8 bytes, row by row)"""
    with open(path, "rb") as file:
        data = file.read()
    header, palette, alphas, packed = None, b"", b"", b""
    for kind, body in chunks(data):
        if kind == b"IHDR":
            header = struct.unpack(">IIBBBBB", body)
        elif kind == b"PLTE":
            palette = body
        elif kind == b"tRNS":
            alphas = body
        elif kind == b"IDAT":
            packed += body
    width, height, depth, colour, _, _, interlace = header
    if colour not in CHANNELS or interlace or (depth != 8 and colour != 3 and not (colour == 0 and depth < 8)):
        raise ValueError(f"unsupported PNG: depth {depth}, colour {colour}, interlace {interlace}")
    step = max(1, CHANNELS[colour] * depth // 8)
    stride = (CHANNELS[colour] * depth * width + 7) // 8
    raw = zlib.decompress(packed)
    previous, rows = bytearray(stride), []
    for y in range(height):
        at = y * (stride + 1)
        row = bytearray(raw[at + 1 : at + 1 + stride])
        unfilter(raw[at], row, previous, step)
        samples = unpack(row, depth, width)
        if colour == 0 and depth < 8:
            samples = bytearray(value * 255 // ((1 << depth) - 1) for value in samples)
        rows.append(to_rgba(samples, colour, palette, alphas))
        previous = row
    return width, height, b"".join(rows)
