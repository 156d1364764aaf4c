// SPDX-License-Identifier: GPL-3.0-or-later
/// The exactly integrated picture of a drawing, for run_coverage.py: width × height pixels, row-major, each four native
/// doubles (premultiplied sRGB), to the standard output. Exit 0, else the class of the error.
#include <charconv>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string_view>

#include "compiler/measure/truth.h"
#include "compiler/svg/svg.h"

namespace fetexc::test {
namespace {

int fail(const Error& error) {
    std::fprintf(stderr, "error E%d: %s: %s\n", error.code, error.place.c_str(), error.message.c_str());
    return static_cast<int>(error.cls);
}

std::uint32_t number(std::string_view text) {
    std::uint32_t value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

int write_picture(const char* file, GridSize pixels) {
    std::ifstream stream(file, std::ios::binary);
    const std::vector<std::uint8_t> bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    std::vector<Diagnostic> diagnostics;
    const auto scene = load_svg(bytes, SvgOptions{}, diagnostics);
    if (!scene) return fail(scene.error());
    const auto truth = measure::Truth::of(scene.value(), 1);
    if (!truth) return fail(truth.error());
    const auto picture = truth.value()->picture(pixels, 1);
    if (!picture) return fail(picture.error());
    const std::size_t count = picture.value().size();
    return std::fwrite(picture.value().data(), sizeof(Rgba), count, stdout) == count ? 0 : 2;
}

} // namespace
} // namespace fetexc::test

int main(int argc, char** argv) {
    if (argc != 4) {
        std::fputs("usage: corpus_exact_picture FILE WIDTH HEIGHT\n", stderr);
        return 1;
    }
    return fetexc::test::write_picture(argv[1], {fetexc::test::number(argv[2]), fetexc::test::number(argv[3])});
}
