// SPDX-License-Identifier: GPL-3.0-or-later
/// Files of any kind that `compare` takes, told apart by what they hold; by their names only where that says nothing.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "compiler/measure/pictures.h"
#include "compiler/result.h"
#include "formats/fetex_file.h"

namespace fetexc::cli {

enum class FileKind : std::uint8_t { Svg, Network, Asset, Png };

struct ComparedFile {
    std::string path;
    FileKind kind = FileKind::Svg;
    std::vector<std::uint8_t> bytes;
};

/// path "-": stdin. What is neither a .fetex nor a PNG by its first bytes, nor called so, is a network if it begins
/// with a brace, else taken for an SVG. Errors: those of read_input.
Result<ComparedFile> read_compared(const std::string& path);

/// An asset or a bitmap, ready to be asked for colours.
struct ComparedPicture {
    std::unique_ptr<const fetex::FetexFile> asset; ///< what its picture looks into
    std::unique_ptr<const measure::Picture> picture;
    std::string description; ///< "FBT of 64 x 48 texels, 12345 bytes on the GPU"
};

/// Not for an SVG or a network. representation: of an asset, as choose_representation takes it. Errors E6001, E6002,
/// E8032.
Result<ComparedPicture> picture_of(const ComparedFile& file, measure::BitmapPicture::Filter filter,
                                   const std::string& representation = {});

/// "sign.svg: path#wheel", where the error says which element.
Error at(const std::string& path, const Error& e);

} // namespace fetexc::cli
