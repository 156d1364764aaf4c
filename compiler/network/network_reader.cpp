// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/network/network_reader.h"

#include <algorithm>
#include <cmath>

#include "compiler/diagnostics.h"
#include "compiler/network/json_members.h"
#include "compiler/network/profile_reader.h"

namespace fetexc {
namespace {

using namespace json;

class Reader {
  public:
    Reader(const Json& root, std::vector<Diagnostic>& diagnostics) : root_(root), diagnostics_(diagnostics) {}

    Network read() {
        const std::string place = "network";
        if (!root_.is_object()) refuse(diag::kNetworkMember, "the network isn't an object", place);
        const Json& schema = member(root_, "schema", place);
        if (schema != "fetexc-network/1")
            refuse(diag::kNetworkMalformed, "the member schema isn't \"fetexc-network/1\"", place);
        check_members(root_, {"schema", "width", "height", "profiles", "profile", "curves"}, place);
        Network network;
        network.width = side("width");
        network.height = side("height");
        reach_ = kNetworkReach * std::max(network.width, network.height);
        if (const auto profiles = root_.find("profiles"); profiles != root_.end())
            network.profiles = read_profiles(*profiles, reach_);
        network.profile = text(root_, "profile", place);
        check_profile(network, network.profile, place);
        const Json& curves = array(member(root_, "curves", place), "curves", place);
        for (const Json& c : curves)
            read_curve(c, network);
        report(network);
        return network;
    }

  private:
    double side(const char* name) const {
        const double v = number(member(root_, name, "network"), name, "network");
        if (!(v > 0 && v <= kNetworkMaxSide))
            refuse(diag::kNetworkNumber, std::string(name) + " isn't between 0 and 1e9", "network");
        return v;
    }

    CanvasPoint point(const Json& numbers, std::size_t at, const std::string& place) const {
        const auto coordinate = [&](std::size_t k) {
            const double v = number(numbers[k], "a coordinate", place);
            if (!(std::abs(v) <= reach_))
                refuse(diag::kNetworkNumber, "a coordinate is more than 1000 canvas sides from the origin", place);
            return v;
        };
        return {coordinate(at), coordinate(at + 1)};
    }

    CanvasSegment segment(const Json& numbers, CanvasPoint from, const std::string& place) const {
        array(numbers, "a segment", place);
        if (numbers.size() != 2 && numbers.size() != 4 && numbers.size() != 6)
            refuse(diag::kNetworkSegment, "a segment hasn't 2, 4 or 6 numbers", place);
        CanvasSegment s;
        s.degree = static_cast<int>(numbers.size() / 2);
        s.p[0] = from;
        for (std::size_t k = 0; k < numbers.size(); k += 2)
            s.p[k / 2 + 1] = point(numbers, k, place);
        return s;
    }

    void read_curve(const Json& c, Network& network) {
        std::string place = "curve " + std::to_string(++curves_);
        if (!c.is_object()) refuse(diag::kNetworkMember, "a curve isn't an object", place);
        NetworkCurve curve;
        curve.name = text(c, "name", place);
        if (!curve.name.empty()) place += " \"" + curve.name + "\"";
        check_members(c, {"name", "closed", "start", "segments", "profile", "left", "right"}, place);
        curve.profile = text(c, "profile", place);
        check_profile(network, curve.profile, place);
        curve.left = color(c, "left", place), curve.right = color(c, "right", place);
        if (const auto closed = c.find("closed"); closed != c.end()) {
            if (!closed->is_boolean()) refuse(diag::kNetworkMember, "closed isn't true or false", place);
            curve.closed = closed->get<bool>();
        }
        read_segments(c, curve, place);
        if (!curve.segments.empty()) network.curves.push_back(std::move(curve));
    }

    static void check_profile(const Network& network, const std::string& name, const std::string& place) {
        if (!name.empty() && !find_profile(network, name))
            refuse(diag::kNetworkProfile, "the network has no profile \"" + name + "\", and it isn't a preset's name",
                   place);
    }

    void read_segments(const Json& c, NetworkCurve& curve, const std::string& place) {
        const Json& start = array(member(c, "start", place), "start", place);
        if (start.size() != 2) refuse(diag::kNetworkMember, "start hasn't two numbers", place);
        const CanvasPoint first = point(start, 0, place);
        CanvasPoint at = first;
        const Json& segments = array(member(c, "segments", place), "segments", place);
        segments_ += segments.size() + 1;
        if (segments_ > kNetworkMaxSegments)
            refuse(diag::kNetworkTooLarge, "the network has more than 2^24 segments", place);
        const auto add = [&](const CanvasSegment& s) {
            if (is_point(s))
                ++points_;
            else
                curve.segments.push_back(s);
        };
        for (std::size_t n = 0; n < segments.size(); ++n) {
            const CanvasSegment s = segment(segments[n], at, place + ", segment " + std::to_string(n + 1));
            at = s.p[static_cast<std::size_t>(s.degree)];
            add(s);
        }
        if (curve.closed && (at.x != first.x || at.y != first.y)) add({1, {at, first}});
    }

    void report(const Network& network) {
        if (points_ > 0)
            diagnostics_.push_back({Severity::Warning, diag::kNetworkPointSegments,
                                    "left out " + std::to_string(points_) + " segments that are a single point", ""});
        if (network.curves.empty())
            diagnostics_.push_back({Severity::Warning, diag::kNetworkEmpty, "the network has no curve", ""});
    }

    const Json& root_;
    std::vector<Diagnostic>& diagnostics_;
    double reach_ = 0;
    std::uint64_t curves_ = 0, segments_ = 0, points_ = 0;
};

} // namespace

Result<Network> read_network(std::span<const std::uint8_t> bytes, std::vector<Diagnostic>& diagnostics) {
    try {
        const Json root = parse(bytes);
        return Reader(root, diagnostics).read();
    } catch (Refused& r) {
        return std::move(r.error);
    }
}

} // namespace fetexc
