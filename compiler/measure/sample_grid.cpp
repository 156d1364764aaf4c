// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/sample_grid.h"

#include "compiler/parallel.h"

namespace fetexc::measure {

SampleGrid::SampleGrid(const Subject& subject, const TruthSamples& truth) : truth_(truth), picture_(truth.size()) {
    const GridSize pixels = truth.pixels();
    parallel_for(pixels.height, subject.threads, [&](std::size_t row) {
        const auto j = static_cast<std::uint32_t>(row);
        for (std::uint32_t i = 0; i < pixels.width; ++i) {
            const std::size_t k = index(i, j);
            const TexturePoint p = point(i, j);
            picture_[k] = subject.classifier.classify(p, truth.result(k), subject.picture.at(p));
        }
    });
}

} // namespace fetexc::measure
