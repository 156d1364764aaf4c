// SPDX-License-Identifier: GPL-3.0-or-later
/// GLSL = CPU reference for a representation, on every back end: frames to look at, and a fixture that draws and
/// compares them. What differs between representations is a `Drawn`:
///
///     using Texture
///     kSide                               pixels of a magnified frame
///     kLargestEdgeShare                   of the pixels may lie on an edge and differ
///     kSamplers                           of points, pixels and levels
///     validate(t), step(t)                validate_<representation>; the largest difference of equal colours
///     upload(renderer, t), draw(renderer, view, size), reference(t, view, size)
///     sampler(t, view, size)              what gives the reference's colour at (x, y), in texels
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/conformance/backend_fixture.h"
#include "tests/conformance/compare_renderers.h"

namespace fetexc::test {

/// The reference's colour at a place in texels.
using ReferenceSampler = std::function<fetex::FbtColor(double x, double y)>;

struct Frame {
    fetex::View view;
    fetex::RenderSize size;
    std::string what; ///< for messages
};

inline constexpr double kMagnifications[] = {1, 8, 64, 512}; ///< pixels per texel

/// Points and pixels, around the middle of the texture and around its corner. Columns and rows of pixels are apart by
/// no multiple of an eighth, or of a pixel: else whole diagonals of them would lie on lines at 45 degrees.
template <class Texture> std::vector<Frame> magnified_frames(const Texture& t, std::uint32_t side) {
    std::vector<Frame> frames;
    for (const double magnification : kMagnifications) {
        const double w = side / magnification / t.width, h = side / magnification / t.height;
        for (const fetex::View& view :
             {fetex::View{0.4713 - w / 2, 0.5229 - h / 2, w, h}, fetex::View{1 - 0.7013 * w, -0.2071 * h, w, h}})
            for (const fetex::Filter filter : {fetex::Filter::Point, fetex::Filter::Area})
                frames.push_back({view, {side, side, 1, filter}, std::to_string(magnification) + " pixels a texel"});
    }
    return frames;
}

/// Levels, at every scale, of square pixels and of flat ones. A texel has samples_a_texel samples a side.
template <class Texture> std::vector<Frame> frames_of_levels(const Texture& t, double samples_a_texel = 1) {
    constexpr fetex::RenderSize kSize{61, 61, 1, fetex::Filter::Area, fetex::Minification::Mips};
    std::vector<Frame> frames;
    for (const double samples : {1.0001, 1.3, 1.9, 2.0, 2.5, 3.0, 4.0, 7.7, 16.0, 33.0, 100.0}) {
        const double w = samples * kSize.width / samples_a_texel / t.width,
                     h = samples * kSize.height / samples_a_texel / t.height;
        const fetex::View view{0.5 - 0.53 * w, 0.5 - 0.48 * h, w, h};
        const std::string what = std::to_string(t.width) + " wide, " + std::to_string(samples) + " samples a pixel";
        frames.push_back({view, kSize, what});
        frames.push_back({{view.x, view.y, w, h / 3}, kSize, what + ", flat"});
    }
    return frames;
}

/// Points and pixels at 512 pixels a texel, from the last texels of a wide texture on.
template <class Texture> std::vector<Frame> frames_far_out(const Texture& t, std::uint32_t side) {
    const double extent = side / 512.0;
    std::vector<Frame> frames;
    for (const double i : {t.width - 1.0, 16000.25, 12345.0})
        for (const fetex::Filter filter : {fetex::Filter::Point, fetex::Filter::Area})
            frames.push_back({{i / t.width, 1.0 / 3, extent / t.width, extent / t.height},
                              {side, side, 1, filter},
                              "texel " + std::to_string(i)});
    return frames;
}

template <class Drawn> class RepresentationConformance : public BackendTest {
  protected:
    using Texture = typename Drawn::Texture;

    void upload(const Texture& t) {
        ASSERT_TRUE(Drawn::validate(t).empty()) << Drawn::validate(t)[0].message;
        const auto bad = drawn_.upload(*renderer_, t);
        ASSERT_FALSE(bad.has_value()) << bad->message;
    }

    /// The uploaded texture. One sample a pixel.
    void expect_equal(const Texture& t, const Frame& frame, const std::string& what) {
        const auto& [view, size, frame_name] = frame;
        const Comparison found = compare_images(t, drawn_.reference(t, view, size), drawn_.draw(*renderer_, view, size),
                                                view, drawn_.sampler(t, view, size), Drawn::step(t));
        EXPECT_TRUE(found.equal()) << what << ", " << frame_name << ": " << found.wrong << " of " << found.pixels
                                   << " pixels wrong, by up to " << found.largest << "; " << found.first_wrong
                                   << found.error;
        EXPECT_LE(static_cast<double>(found.on_edge), Drawn::kLargestEdgeShare * static_cast<double>(found.pixels))
            << what << ", " << frame_name;
        total_.add(found);
    }
    void expect_equal(const Texture& t, const std::vector<Frame>& frames, const std::string& what) {
        for (const Frame& frame : frames)
            expect_equal(t, frame, what);
    }
    /// Uploads it; its levels, if there are any, and a part.
    void expect_equal_after_others(const Texture& t, const std::string& what) {
        constexpr fetex::RenderSize kSize{48, 48, 1, fetex::Filter::Area, fetex::Minification::Mips};
        upload(t);
        if (!t.mips.empty()) expect_equal(t, Frame{{-1, -1, 20, 20}, kSize, "levels"}, what);
        expect_equal(t, Frame{{0.1, 0.1, 0.5, 0.5}, kSize, "a part"}, what);
    }

    void expect_supersampled(const Texture& t) {
        constexpr fetex::View kView{-0.25, 0.1, 1.5, 0.8};
        upload(t);
        for (const fetex::Filter filter : {fetex::Filter::Point, fetex::Filter::Area}) {
            const fetex::RenderSize size{70, 50, 4, filter};
            const auto reference = drawn_.reference(t, kView, size);
            const auto drawn = drawn_.draw(*renderer_, kView, size);
            ASSERT_TRUE(reference.ok() && drawn.ok());
            EXPECT_LE(different_share(reference.value(), drawn.value()), Drawn::kLargestEdgeShare);
        }
    }

    /// Precondition: nothing is uploaded; t has no levels.
    void expect_errors(const Texture& t, const Texture& too_large) {
        using fetex::RuntimeErrc;
        constexpr fetex::RenderSize kSize{4, 4, 1};
        EXPECT_EQ(drawn_.draw(*renderer_, {}, kSize).error().code, RuntimeErrc::NothingUploaded);
        for (const fetex::Sampler sampler : Drawn::kSamplers)
            EXPECT_EQ(renderer_->time_draws(sampler, {}, 16, 1).error().code, RuntimeErrc::NothingUploaded);
        EXPECT_EQ(drawn_.draw(*renderer_, {0, 0, -1, 1}, kSize).error().code, RuntimeErrc::BadView);
        upload(t);
        EXPECT_FALSE(renderer_->time_draws(Drawn::kSamplers[2], {}, 16, 1).ok()); // it has no levels
        const auto bad = drawn_.upload(*renderer_, too_large);
        ASSERT_TRUE(bad.has_value());
        EXPECT_EQ(bad->code, RuntimeErrc::TextureTooLarge);
        EXPECT_TRUE(drawn_.draw(*renderer_, {}, kSize).ok()); // what was there stays
    }

    void report(const char* what) const {
        std::printf("  %s, %s: %llu pixels, %llu on an edge, largest difference %.2e\n", describe(GetParam()).c_str(),
                    what, static_cast<unsigned long long>(total_.pixels),
                    static_cast<unsigned long long>(total_.on_edge), total_.largest);
    }

    Drawn drawn_;
    Comparison total_;
};

} // namespace fetexc::test
