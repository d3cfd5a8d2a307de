#include "src/raster/lanes/fragment_reuse.h"

namespace ninebit {

void plan_reuse(std::span<LanePass> passes) {
  for (std::size_t i = 1; i < passes.size(); ++i) {
    LanePass& last = passes[i - 1];
    LanePass& pass = passes[i];
    last.notes_owners = last.draws_nearest_alone() && pass.can_reuse();
    if (!last.can_reuse() || !pass.can_reuse()) continue;
    pass.role = FragmentRole::repeats;
    if (last.role == FragmentRole::draws) last.role = FragmentRole::keeps;
  }
}

void FragmentReuse::begin_pass(FragmentRole role) {
  if (role == FragmentRole::repeats) return;
  kept_ = 0;
  has_kept_all_ = true;
  begin_batch(false);
}

void FragmentReuse::begin_batch(bool keeps) {
  if (keeps && kept_ + 1 < kMostKept) {
    ++kept_;
  } else if (keeps) {
    has_kept_all_ = false;
  }
  if (batches_.size() == kept_) batches_.push_back(std::make_unique<LaneFragments>());
  gathering_ = batches_[kept_].get();
  gathering_->clear();
  occupied_.fill(0);
}

}  // namespace ninebit
