#include "app/gui/terrain_frame.hpp"

#include <algorithm>
#include <set>

namespace terrawalk::gui {

namespace {
constexpr std::size_t kLeast = 40'000, kGreatest = 2'000'000;
constexpr std::size_t kMostBlocks = 4096;
}  // namespace

void FrameBudget::took(std::size_t triangles, double ms) {
    if (triangles < kLeast / 2 || ms <= 0.0) return;
    const double fits = static_cast<double>(triangles) * aim_ms_ / ms;
    // A slow frame may be chance: half way each time.
    const double next = (static_cast<double>(triangles_) + fits) / 2.0;
    triangles_ = static_cast<std::size_t>(
        std::clamp(next, static_cast<double>(kLeast), static_cast<double>(kGreatest)));
}

const TerrainBlock& BlockStore::make(const TerrainScene& scene, BlockLevel which) {
    auto& block = built_[which];
    if (!block) block = std::make_unique<TerrainBlock>(scene.build(which));
    return *block;
}

std::vector<BlockStore::Ready> BlockStore::ready(const TerrainScene& scene,
                                                 const std::vector<BlockLevel>& chosen,
                                                 std::chrono::milliseconds time) {
    const Clock::time_point end = Clock::now() + time;
    complete_ = true;
    std::vector<Ready> list;
    for (const BlockLevel wanted : chosen) {
        BlockLevel which = wanted;
        if (!holds(wanted) && Clock::now() >= end) {
            complete_ = false;
            which.level = TerrainScene::kLevels - 1;
            for (std::uint32_t away = 1; away < TerrainScene::kLevels; ++away) {
                const BlockLevel coarser{wanted.block, wanted.level + away};
                const BlockLevel finer{wanted.block, wanted.level - away};
                if (holds(coarser) || (away <= wanted.level && holds(finer))) {
                    which = holds(coarser) ? coarser : finer;
                    break;
                }
            }
        }
        list.push_back({which, &make(scene, which)});
    }
    if (built_.size() > kMostBlocks + chosen.size()) {
        std::set<BlockLevel> used;
        for (const Ready& r : list) used.insert(r.which);
        std::erase_if(built_, [&](const auto& entry) {
            return !used.contains(entry.first) && entry.first.level + 1 < TerrainScene::kLevels;
        });
    }
    return list;
}

}  // namespace terrawalk::gui
