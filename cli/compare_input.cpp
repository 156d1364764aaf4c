// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/compare_input.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "cli/compile_bilevel.h"
#include "cli/compile_curves.h"
#include "cli/compile_pinchmap.h"
#include "cli/compile_silmap.h"
#include "cli/fetex_input.h"
#include "cli/image_file.h"
#include "cli/io.h"
#include "compiler/diagnostics.h"

namespace fetexc::cli {
namespace {

FileKind kind_of(const std::string& path, const std::vector<std::uint8_t>& bytes) {
    const auto starts_with = [&](std::string_view magic) {
        return bytes.size() >= magic.size() &&
               std::equal(magic.begin(), magic.end(), bytes.begin(),
                          [](char a, auto b) { return static_cast<std::uint8_t>(a) == b; });
    };
    if (starts_with("\x89"
                    "FTX"))
        return FileKind::Asset;
    if (starts_with("\x89PNG")) return FileKind::Png;
    if (path.ends_with(".fetex")) return FileKind::Asset; // and damaged
    if (path.ends_with(".png")) return FileKind::Png;
    return is_network(bytes) ? FileKind::Network : FileKind::Svg;
}

std::string name_of(const fetex::FbtTexture&) { return "FBT"; }
std::string name_of(const fetex::BilevelTexture& t) { return fmt::format("bi-level texture ({})", rule_name(t.rule)); }
std::string name_of(const fetex::SilmapTexture& t) {
    return fmt::format("silhouette-map texture ({}-bit cells)", cell_bits(t));
}

std::string name_of(const fetex::FeatureCurvesTexture& t) {
    return fmt::format("texture with feature curves ({}s)", kind_name(t.kind));
}
std::string name_of(const fetex::PinchmapTexture& t) { return fmt::format("pinchmap ({}-bit map)", map_bits(t)); }

Result<ComparedPicture> asset_picture(const ComparedFile& file, const std::string& representation) {
    auto input = fetex_of_bytes(file.bytes, file.path);
    if (!input) return input.error();
    if (const Status s = choose_representation(input.value().file, representation, file.path); !s) return s.error();
    ComparedPicture out;
    out.asset = std::make_unique<const fetex::FetexFile>(std::move(input.value().file));
    out.picture = with_texture(*out.asset, [](const auto& texture) { return measure::picture_of(texture); });
    const GridSize size = out.picture->texels();
    out.description = fmt::format("{} of {} x {} texels, {} bytes on the GPU",
                                  with_texture(*out.asset, [](const auto& texture) { return name_of(texture); }),
                                  size.width, size.height, out.picture->gpu_bytes());
    return out;
}

Result<ComparedPicture> bitmap_picture(const ComparedFile& file, measure::BitmapPicture::Filter filter) {
    auto decoded = decode_png(file.bytes);
    if (!decoded) return Error{decoded.error().cls, decoded.error().code, decoded.error().message, file.path};
    const GridSize size{decoded.value().width, decoded.value().height};
    ComparedPicture out;
    out.picture = std::make_unique<const measure::BitmapPicture>(size, std::move(decoded.value().rgba), filter);
    out.description = fmt::format("bitmap of {} x {} texels, {} lookup, {} bytes on the GPU", size.width, size.height,
                                  filter == measure::BitmapPicture::Filter::Nearest ? "nearest" : "bilinear",
                                  out.picture->gpu_bytes());
    return out;
}

} // namespace

Result<ComparedFile> read_compared(const std::string& path) {
    auto bytes = read_input(path, kMaxFetexBytes);
    if (!bytes) return bytes.error();
    const FileKind kind = kind_of(path, bytes.value());
    return ComparedFile{path, kind, std::move(bytes).value()};
}

Result<ComparedPicture> picture_of(const ComparedFile& file, measure::BitmapPicture::Filter filter,
                                   const std::string& representation) {
    return file.kind == FileKind::Asset ? asset_picture(file, representation) : bitmap_picture(file, filter);
}

Error at(const std::string& path, const Error& e) {
    return {e.cls, e.code, e.message, e.place.empty() ? path : fmt::format("{}: {}", path, e.place)};
}

} // namespace fetexc::cli
