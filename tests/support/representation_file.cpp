// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/representation_file.h"

#include "tests/support/known_pinchmap.h"
#include "tests/support/random_bilevel.h"
#include "tests/support/random_fbt.h"
#include "tests/support/random_features.h"
#include "tests/support/random_silmap.h"

namespace fetexc::test {

fetex::FetexFile file_of_all_representations() {
    fetex::FetexFile file;
    file.metadata = {{"k", "v"}};
    file.fbt = random_fbt(21, {.width = 3, .height = 2, .mips = true});
    file.bilevel = random_bilevel(1, {.mips = true});
    file.silmap = random_silmap(1, {.mips = true});
    file.pinchmap = pinchmap_of(mask_of({"..##", "..##", "...."}), {.mips = true});
    file.feature_curves = random_features(1, {.mips = true});
    return file;
}

std::size_t representations_in(const fetex::FetexFile& file) {
    return std::size_t{file.fbt.has_value()} + file.bilevel.has_value() + file.silmap.has_value() +
           file.pinchmap.has_value() + file.feature_curves.has_value();
}

Chunks chunks_of(const Bytes& bytes) {
    fetex::ContainerView container;
    EXPECT_FALSE(fetex::read_container(container, bytes).has_value());
    Chunks chunks;
    for (const fetex::ChunkView& c : container.chunks)
        chunks.push_back({c.type, c.flags, c.representation, c.level, {c.payload.begin(), c.payload.end()}});
    return chunks;
}

std::size_t payload_offset(const Bytes& bytes, std::size_t chunk) {
    fetex::ContainerView container;
    EXPECT_FALSE(fetex::read_container(container, bytes).has_value());
    return static_cast<std::size_t>(container.chunks.at(chunk).offset);
}

} // namespace fetexc::test
