// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/truth.h"

#include "compiler/measure/edge_index.h"
#include "compiler/measure/exact_picture.h"
#include "compiler/planar/visible_edges.h"
#include "compiler/scene/ground_truth.h"

namespace fetexc::measure {

struct Truth::Impl {
    explicit Impl(const Scene& s) : scene(s), height(s.extent.height / s.extent.width), truth(s), compositor(s) {}

    const Scene& scene;
    double height;
    GroundTruth truth;
    mutable Compositor compositor; ///< thread-safe; asking it a new question gives a new id
    std::vector<VisibleEdge> edges;
    std::unique_ptr<EdgeIndex> index;
};

Truth::Truth() = default;
Truth::~Truth() = default;

Result<std::unique_ptr<Truth>> Truth::of(const Scene& scene, unsigned threads) {
    std::unique_ptr<Truth> truth(new Truth);
    truth->impl_ = std::make_unique<Impl>(scene);
    Impl& impl = *truth->impl_;
    Result<std::vector<VisibleEdge>> edges = visible_edges(scene, impl.compositor, threads);
    if (!edges) return edges.error();
    impl.edges = std::move(edges).value();
    impl.index = std::make_unique<EdgeIndex>(impl.edges, impl.height);
    return truth;
}

const Scene& Truth::scene() const { return impl_->scene; }

double Truth::height() const { return impl_->height; }

ResultId Truth::result_at(TexturePoint p) const {
    const Extent& e = impl_->scene.extent;
    return impl_->truth.result_at(impl_->compositor, p.u * static_cast<double>(e.lattice_w),
                                  p.v * static_cast<double>(e.lattice_h));
}

Rgba Truth::color(ResultId result, TexturePoint p) const {
    const Extent& e = impl_->scene.extent;
    return impl_->compositor.color(result, {p.u * e.width, p.v * e.height});
}

bool Truth::is_solid(ResultId result) const { return impl_->compositor.is_solid(result); }

std::span<const VisibleEdge> Truth::edges() const { return impl_->edges; }

EdgePoint Truth::nearest_edge(TexturePoint p, double radius) const {
    return impl_->index->nearest(to_width(p), radius);
}

EdgePoint Truth::nearest_on(std::uint32_t edge, TexturePoint p, double radius) const {
    return impl_->index->nearest_on(edge, to_width(p), radius);
}

bool Truth::edge_within(TexturePoint p, double radius) const { return impl_->index->any_within(to_width(p), radius); }

void Truth::edges_near(TexturePoint p, double radius, std::vector<std::uint32_t>& out) const {
    impl_->index->near(to_width(p), radius, out);
}

Result<std::vector<Rgba>> Truth::picture(GridSize pixels, unsigned threads) const {
    return exact_picture(impl_->scene, impl_->compositor, pixels, threads);
}

} // namespace fetexc::measure
