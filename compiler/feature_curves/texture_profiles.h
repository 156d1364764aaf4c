// SPDX-License-Identifier: GPL-3.0-or-later
/// The profiles that a texture with feature curves holds, and which of them a curve has.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compiler/network/network.h"
#include "formats/feature_curves.h"

namespace fetexc {

class TextureProfiles {
  public:
    /// One for all curves.
    explicit TextureProfiles(FeatureProfile profile);
    /// As the curves ask for: first what most of them ask for, the first of equals, which curves that ask for none have
    /// too; then the others in the order of the curves, up to kFeatureProfilesMost. None at all: the preset crease.
    explicit TextureProfiles(const Network& network);

    [[nodiscard]] const std::vector<FeatureProfile>& profiles() const { return profiles_; }
    /// Of a curve, also of one that was simplified since: an index of profiles().
    [[nodiscard]] std::uint8_t number_of(const NetworkCurve& curve) const;
    /// Curves that ask for one beyond those, and have the first; the name that one of them asks for.
    [[nodiscard]] std::uint64_t curves_beyond() const { return curves_beyond_; }
    [[nodiscard]] const std::string& name_beyond() const { return name_beyond_; }

  private:
    [[nodiscard]] const std::string& wanted(const NetworkCurve& curve) const {
        return curve.profile.empty() ? of_the_network_ : curve.profile;
    }

    std::string of_the_network_;
    std::vector<FeatureProfile> profiles_; ///< at least one
    std::vector<std::string> names_;       ///< of profiles_; empty: one for all
    std::uint64_t curves_beyond_ = 0;
    std::string name_beyond_;
};

} // namespace fetexc
