// SPDX-License-Identifier: Apache-2.0 OR MIT
/// What is drawn and what comes out, the same for every renderer.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fetex {

/// The part of the texture to draw, in texture space: x right, y down, [0,1]² is the whole texture. Beyond it the edge
/// is repeated. Limits: finite, w and h > 0, all of magnitude at most kMaxView.
struct View {
    double x = 0, y = 0, w = 1, h = 1;
};
inline constexpr double kMaxView = 16384;

/// What a sample of an FBT is: the colour at its point, or the mean over its part of the pixel, with one texel speaking
/// for all with features or with every texel looked at (formats/SPEC.md, 4.1).
enum class Filter : std::uint8_t { Point, Area, ExactArea };
/// How more than one texel a pixel is drawn.
enum class Minification : std::uint8_t {
    Supersample, ///< as everything else
    Mips,        ///< from the texture's mip chain, if it has one, once a pixel
};

/// Pixels to draw, and N×N samples in each, on a regular grid, averaged (premultiplied, sRGB-encoded values).
struct RenderSize {
    std::uint32_t width = 0, height = 0; ///< 1 … kMaxImageSide
    std::uint32_t supersample = 1;       ///< 1 … kMaxSupersample
    Filter filter = Filter::Point;       ///< of an FBT
    Minification minification = Minification::Supersample;
};
inline constexpr std::uint32_t kMaxImageSide = 32768, kMaxSupersample = 16;
inline constexpr std::uint64_t kMaxImagePixels = 1u << 26; ///< 1 GiB of floats

/// Premultiplied sRGB RGBA, 0…1 (of samples in halves colours up to 65504), row-major, top row first.
struct Image {
    std::uint32_t width = 0, height = 0;
    std::vector<float> rgba;
};

/// Nearest 8-bit values, clamped.
std::vector<std::uint8_t> to_rgba8(const Image& image);

/// Numbers as in the compiler's list of diagnostics: 7xxx is the runtime.
enum class RuntimeErrc : int {
    BadView = 7001,           ///< view or size outside its limits
    BackendMissing = 7002,    ///< library, display or device isn't there
    ContextFailed = 7003,     ///< the back end is there, but gives no context
    GlTooOld = 7004,          ///< functions or formats that the runtime needs are missing
    ShaderFailed = 7005,      ///< compile or link error, with the log
    TextureTooLarge = 7006,   ///< beyond this device's limits
    NothingUploaded = 7007,   ///< render before upload
    OutOfMemoryOrLost = 7008, ///< GL reported an error while drawing
};

struct RuntimeError {
    RuntimeErrc code{};
    std::string message;
};

/// Value or error.
template <class T> class [[nodiscard]] Outcome {
  public:
    Outcome(T value) : value_(std::move(value)) {}
    Outcome(RuntimeError error) : error_(std::move(error)) {}
    [[nodiscard]] bool ok() const { return value_.has_value(); }
    explicit operator bool() const { return ok(); }
    [[nodiscard]] T& value() { return *value_; }
    [[nodiscard]] const T& value() const { return *value_; }
    [[nodiscard]] const RuntimeError& error() const { return error_; }

  private:
    std::optional<T> value_;
    RuntimeError error_;
};

/// nullopt: all is well.
using RuntimeStatus = std::optional<RuntimeError>;

} // namespace fetex
