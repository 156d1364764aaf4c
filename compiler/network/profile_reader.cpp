// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/network/profile_reader.h"

#include <cmath>

#include "compiler/network/network_reader.h"

namespace fetexc {
namespace {

using namespace json;

class ProfileReader {
  public:
    ProfileReader(const Json& object, std::string place, double reach)
        : object_(object), place_(std::move(place)), reach_(reach) {}

    FeatureProfile read(std::string name) {
        if (!object_.is_object()) refuse(diag::kNetworkMember, "a profile isn't an object", place_);
        check_members(object_, {"preset", "width", "inner", "height", "heights", "blends", "color", "colors"}, place_);
        FeatureProfile p;
        p.heights = points("heights", -reach_, reach_), p.blends = points("blends", 0, 1);
        read_shape(p);
        p.name = std::move(name);
        p.inner = optional_number("inner", 0, p.width).value_or(0);
        read_colors(p);
        return p;
    }

  private:
    void read_shape(FeatureProfile& p) {
        const std::string preset = text(object_, "preset", place_);
        if (preset.empty() == p.heights.empty())
            refuse(diag::kNetworkProfile, "a profile needs either a preset or heights", place_);
        if (!preset.empty()) {
            const double width = number(member(object_, "width", place_), "width", place_);
            const auto made = preset_profile(preset, checked(width, "width", 0, reach_));
            if (!made) refuse(diag::kNetworkProfile, "there is no preset \"" + preset + "\"", place_);
            p.shape = made->shape, p.width = made->width;
            p.height = optional_number("height", 0, reach_).value_or(made->height);
        } else {
            if (object_.contains("height"))
                refuse(diag::kNetworkProfile, "the height is for presets; heights say it all", place_);
            if (p.heights.size() < 2) refuse(diag::kNetworkProfile, "heights has less than two points", place_);
            p.shape = ProfileShape::Table;
            p.width = optional_number("width", 0, reach_).value_or(p.heights.back().distance);
        }
        if (!(p.width > 0)) refuse(diag::kNetworkNumber, "a width isn't above 0", place_);
    }

    void read_colors(FeatureProfile& p) {
        const auto one = color(object_, "color", place_);
        if (one) p.colors = {{0, *one}};
        const auto found = object_.find("colors");
        if (found == object_.end()) return;
        if (one) refuse(diag::kNetworkProfile, "a profile has a color or colors, not both", place_);
        for (const Json& row : rows(*found, "colors")) {
            p.colors.push_back({distance(row, "colors", p.colors), color_numbers(row, 1, "colors", place_)});
        }
    }

    double checked(double v, const char* name, double least, double most) const {
        if (!(v >= least && v <= most))
            refuse(diag::kNetworkNumber, std::string(name) + " has a number outside its range", place_);
        return v;
    }

    std::optional<double> optional_number(const char* name, double least, double most) const {
        const auto found = object_.find(name);
        if (found == object_.end()) return std::nullopt;
        return checked(number(*found, name, place_), name, least, most);
    }

    const Json& rows(const Json& table, const char* name) const {
        array(table, name, place_);
        if (table.empty() || table.size() > kProfileMaxPoints)
            refuse(diag::kNetworkProfile, std::string(name) + " has no point, or more than 65536", place_);
        return table;
    }

    /// Of a row; after those before it.
    template <class Point> double distance(const Json& row, const char* name, const std::vector<Point>& before) const {
        array(row, name, place_);
        if (row.empty()) refuse(diag::kNetworkMember, std::string(name) + " has an empty point", place_);
        const double d = checked(number(row[0], name, place_), name, 0, reach_);
        if (before.empty() ? d != 0 : !(d > before.back().distance))
            refuse(diag::kNetworkProfile, "distances of " + std::string(name) + " don't increase from 0", place_);
        return d;
    }

    std::vector<ProfilePoint> points(const char* name, double least, double most) const {
        std::vector<ProfilePoint> out;
        const auto found = object_.find(name);
        if (found == object_.end()) return out;
        for (const Json& row : rows(*found, name)) {
            const double d = distance(row, name, out);
            if (row.size() != 2)
                refuse(diag::kNetworkMember, std::string(name) + " has a point without two numbers", place_);
            out.push_back({d, checked(number(row[1], name, place_), name, least, most)});
        }
        return out;
    }

    const Json& object_;
    std::string place_;
    double reach_;
};

} // namespace

std::vector<FeatureProfile> read_profiles(const Json& object, double reach) {
    if (!object.is_object()) refuse(diag::kNetworkMember, "profiles isn't an object", "network");
    std::vector<FeatureProfile> out;
    for (const auto& [name, value] : object.items())
        out.push_back(ProfileReader(value, "profile \"" + name + "\"", reach).read(name));
    return out;
}

Result<FeatureProfile> read_profile(std::span<const std::uint8_t> bytes) {
    try {
        const Json object = parse(bytes);
        return ProfileReader(object, "profile", kNetworkReach * kNetworkMaxSide).read("");
    } catch (Refused& r) {
        return std::move(r.error);
    }
}

} // namespace fetexc
