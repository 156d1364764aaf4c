// SPDX-License-Identifier: GPL-3.0-or-later
/// Rules that leave out work without changing a byte of the output (DESIGN §8). Each can be switched off, to measure
/// what it saves (tests/bench) and to check that it changes nothing: `fetexc compile --no-skip=RULE`, hidden.
#pragma once

#include <array>

namespace fetexc {

struct SkipRules {
    bool layers = true;        ///< layers outside the canvas or hidden under opaque ones leave the scene
    bool outside = true;       ///< curves right of, above or below the canvas take no part
    bool fans = true;          ///< many lines that end in one point: their pairs are counted, not visited
    bool shared_ends = true;   ///< arcs whose boxes meet in a common end only have no other common point
    bool certificate = true;   ///< pairs that double arithmetic decides need no exact arithmetic
    bool empty_texels = true;  ///< texels without edges are not swept
    bool direct_sweep = true;  ///< texels are swept directly; without it CGAL's Arrangement_2 and decompose do it
    bool first_sweep = true;   ///< where every edge is visible and no band line cuts any, one sweep says it all
    bool known_results = true; ///< the visible result of a set of shapes that came up before is looked up
    bool hidden_fills = true;  ///< compositing starts at the topmost opaque fill
};

struct SkipRule {
    const char* name; ///< for --no-skip
    bool SkipRules::*rule;
};
inline constexpr std::array<SkipRule, 10> kSkipRules{{{"layers", &SkipRules::layers},
                                                      {"outside", &SkipRules::outside},
                                                      {"fans", &SkipRules::fans},
                                                      {"shared-ends", &SkipRules::shared_ends},
                                                      {"certificate", &SkipRules::certificate},
                                                      {"empty-texels", &SkipRules::empty_texels},
                                                      {"direct-sweep", &SkipRules::direct_sweep},
                                                      {"first-sweep", &SkipRules::first_sweep},
                                                      {"known-results", &SkipRules::known_results},
                                                      {"hidden-fills", &SkipRules::hidden_fills}}};

} // namespace fetexc
