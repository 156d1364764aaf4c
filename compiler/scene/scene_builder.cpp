// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/scene/scene_builder.h"

#include <algorithm>
#include <utility>

#include "compiler/scene/clip_tree.h"
#include "compiler/scene/compact.h"
#include "compiler/scene/culling.h"
#include "compiler/scene/lattice.h"
#include "compiler/scene/snap.h"
#include "compiler/scene/tree.h"
#include "compiler/scene/validate.h"

namespace fetexc {
namespace {

void count_layers(Scene& scene) {
    for (const Node& node : scene.nodes) {
        if (node.kind != Node::Kind::Fill) continue;
        ++scene.stats.layers_in;
        if (std::holds_alternative<RasterPaint>(scene.paints[node.paint])) ++scene.stats.raster_layers;
    }
}

/// Needs the rebuilt tree: before, mask contents may lie inside groups they have nothing to do with.
void cull(Scene& scene) {
    const std::vector<LatticeBox> shapes = shape_boxes(scene);
    const std::vector<bool> invisible = find_invisible_fills(scene, shapes);
    rebuild_tree(scene, invisible, true);
    const std::vector<bool> hidden = find_hidden_fills(scene, shapes);
    if (std::find(hidden.begin(), hidden.end(), true) != hidden.end()) rebuild_tree(scene, hidden, true);
}

} // namespace

SceneBuilder::SceneBuilder(double width, double height) {
    scene_.extent.width = width;
    scene_.extent.height = height;
}

std::uint32_t SceneBuilder::add_shape(std::vector<CanvasContour> contours, FillRule rule, std::uint32_t element) {
    raw_.push_back({std::move(contours), rule, element});
    return static_cast<std::uint32_t>(raw_.size() - 1);
}

std::uint32_t SceneBuilder::add_element(std::string name) {
    scene_.elements.push_back({std::move(name)});
    return static_cast<std::uint32_t>(scene_.elements.size() - 1);
}

Result<Scene> SceneBuilder::finish(const SceneBuilderOptions& options) {
    Result<Extent> extent = make_extent(scene_.extent.width, scene_.extent.height);
    if (!extent) return extent.error();
    Scene scene = std::exchange(scene_, Scene{});
    scene.extent = extent.value();
    if (Status status = snap_shapes(raw_, scene); !status) return status.error();
    raw_.clear();
    if (Status status = validate_scene(scene); !status) return status.error();
    count_layers(scene);
    rebuild_tree(scene, {}, false);
    if (options.cull) cull(scene);
    remove_unreferenced(scene);
    return scene;
}

} // namespace fetexc
