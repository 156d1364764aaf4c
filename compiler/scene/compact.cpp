// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/scene/compact.h"

#include <utility>

namespace fetexc {
namespace {

/// Reachability first (as 0/1), then the new index of everything kept.
struct Renumbering {
    std::vector<std::uint32_t> shapes, paints, clips, masks;
};

class Marker {
  public:
    explicit Marker(const Scene& scene) : scene_(scene) {
        used_.shapes.assign(scene.shapes.size(), 0);
        used_.paints.assign(scene.paints.size(), 0);
        used_.clips.assign(scene.clips.size(), 0);
        used_.masks.assign(scene.masks.size(), 0);
    }

    Renumbering run() {
        mark_nodes(0, scene_.root_end);
        while (!pending_masks_.empty() || !pending_clips_.empty())
            mark_pending();
        return std::move(used_);
    }

  private:
    void mark_nodes(std::uint32_t first, std::uint32_t end) {
        for (std::uint32_t i = first; i < end; ++i) {
            const Node& node = scene_.nodes[i];
            mark_clip(node.clip);
            if (node.kind == Node::Kind::Group) {
                mark_mask(node.mask);
            } else {
                used_.shapes[node.shape] = 1;
                used_.paints[node.paint] = 1;
            }
        }
    }
    void mark_clip(std::uint32_t clip) {
        if (clip == kNone || used_.clips[clip] != 0) return;
        used_.clips[clip] = 1;
        pending_clips_.push_back(clip);
    }
    void mark_mask(std::uint32_t mask) {
        if (mask == kNone || used_.masks[mask] != 0) return;
        used_.masks[mask] = 1;
        pending_masks_.push_back(mask);
    }
    void mark_pending() {
        if (!pending_clips_.empty()) {
            const Clip& clip = scene_.clips[pending_clips_.back()];
            pending_clips_.pop_back();
            mark_clip(clip.parent);
            for (const ClipMember& member : clip.members) {
                used_.shapes[member.shape] = 1;
                mark_clip(member.clip);
            }
        } else {
            const Mask& mask = scene_.masks[pending_masks_.back()];
            pending_masks_.pop_back();
            mark_mask(mask.parent);
            if (mask.region_shape != kNone) used_.shapes[mask.region_shape] = 1;
            mark_nodes(mask.first, mask.end);
        }
    }

    const Scene& scene_;
    Renumbering used_;
    std::vector<std::uint32_t> pending_clips_, pending_masks_;
};

/// Moves what is marked to the front; `marks` become new indices.
template <class T> void keep_marked(std::vector<T>& items, std::vector<std::uint32_t>& marks) {
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (marks[i] == 0) continue;
        if (kept != i) items[kept] = std::move(items[i]);
        marks[i] = kept++;
    }
    items.erase(items.begin() + kept, items.end());
}

void keep_shapes(Scene& scene, std::vector<std::uint32_t>& marks) {
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
        if (marks[i] == 0) continue;
        Shape& shape = scene.shapes[i];
        for (std::uint32_t k = 0; k < shape.count; ++k)
            scene.segments[kept + k] = scene.segments[shape.first + k];
        shape.first = kept;
        kept += shape.count;
    }
    scene.segments.resize(kept);
    keep_marked(scene.shapes, marks);
}

/// Drops the content of unused masks behind the picture.
void keep_mask_nodes(Scene& scene, const std::vector<std::uint32_t>& marks) {
    std::vector<Node> nodes(scene.nodes.begin(), scene.nodes.begin() + scene.root_end);
    for (std::size_t i = 0; i < scene.masks.size(); ++i) {
        if (marks[i] == 0) continue;
        Mask& mask = scene.masks[i];
        const auto first = static_cast<std::uint32_t>(nodes.size());
        for (std::uint32_t k = mask.first; k < mask.end; ++k) {
            nodes.push_back(scene.nodes[k]);
            nodes.back().end = nodes.back().end - mask.first + first;
        }
        mask.first = first;
        mask.end = static_cast<std::uint32_t>(nodes.size());
    }
    scene.nodes = std::move(nodes);
}

void renumber(std::uint32_t& index, const std::vector<std::uint32_t>& map) {
    if (index != kNone) index = map[index];
}

void renumber_all(Scene& scene, const Renumbering& map) {
    for (Node& node : scene.nodes) {
        renumber(node.clip, map.clips);
        renumber(node.mask, map.masks);
        renumber(node.shape, map.shapes);
        renumber(node.paint, map.paints);
    }
    for (Clip& clip : scene.clips) {
        renumber(clip.parent, map.clips);
        for (ClipMember& member : clip.members) {
            renumber(member.shape, map.shapes);
            renumber(member.clip, map.clips);
        }
    }
    for (Mask& mask : scene.masks) {
        renumber(mask.parent, map.masks);
        renumber(mask.region_shape, map.shapes);
    }
}

/// What the other kind of node would use is cleared, so that stray indices of the input don't survive.
void clear_unused_fields(std::vector<Node>& nodes) {
    for (Node& node : nodes) {
        if (node.kind == Node::Kind::Group)
            node.shape = node.paint = kNone;
        else
            node.mask = kNone, node.blend = Blend::Normal, node.isolated = false;
    }
}

} // namespace

void remove_unreferenced(Scene& scene) {
    clear_unused_fields(scene.nodes);
    Renumbering map = Marker(scene).run();
    keep_mask_nodes(scene, map.masks);
    keep_shapes(scene, map.shapes);
    keep_marked(scene.paints, map.paints);
    keep_marked(scene.clips, map.clips);
    keep_marked(scene.masks, map.masks);
    renumber_all(scene, map);
}

} // namespace fetexc
