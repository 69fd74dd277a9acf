#include "render/frame_gaps.h"

#include <algorithm>

namespace anthrob {
namespace mocap {

void FrameGaps::add(const std::string& frame, double t) {
  const auto [at, fresh] = frames_.emplace(frame, Stamps{t, {}});
  Stamps& stamps = at->second;
  if (fresh) return;
  if (t < stamps.last - options_.memory) stamps = {t, {}};
  if (t - stamps.last > options_.longest) stamps.gaps.emplace_back(stamps.last, t);
  stamps.last = std::max(stamps.last, t);
  while (!stamps.gaps.empty() && stamps.gaps.front().second < stamps.last - options_.memory) {
    stamps.gaps.pop_front();
  }
}

bool FrameGaps::hold(const std::string& frame, double t) const {
  const auto at = frames_.find(frame);
  if (at == frames_.end()) return false;
  return std::any_of(at->second.gaps.begin(), at->second.gaps.end(),
                     [t](const auto& gap) { return gap.first < t && t < gap.second; });
}

}  // namespace mocap
}  // namespace anthrob
