#include "diagnosis/location.h"

#include <algorithm>

#include "diagnosis/seams.h"
#include "judgement/excess.h"

namespace anthrob {
namespace discovery {

namespace {

std::string subsystem_of(const Place& place, const std::vector<SeamGap>& seams,
                         const SeamOptions& options) {
  std::string subsystem;
  for (const SeamGap& seam : seams) {
    if (seam.place == place.place && seam.channel == place.channel) {
      subsystem = subsystem_of(seam, options);
    }
  }
  return subsystem;
}

}  // namespace

std::string regime_of(const std::string& channel, const std::vector<Dependence>& dependences,
                      double telling) {
  std::string what;
  double best = telling, constant = 0.0;
  for (const Dependence& d : dependences) {
    if (d.channel.rfind(channel, 0) != 0) continue;
    constant = std::max(constant, d.constant);
    if (d.predicted() <= best) continue;
    best = d.predicted();
    what = d.on_what();
  }
  if (constant <= best) return what;
  return what.empty() ? "nothing: off by a constant"
                      : "mostly off by a constant; the rest: " + what;
}

std::vector<Place> locate(const Judge& judge, const Eigen::VectorXf& residual, double least,
                          const Scales& scales, const std::vector<SeamGap>& seams,
                          const std::vector<Dependence>& dependences,
                          const DiagnosisOptions& options) {
  const auto gaps = judge.channel_gaps(residual);
  const auto significance = judge.excess_significance(residual, least);
  double whole = 0.0;
  for (const auto& [name, gap] : gaps) whole += excess(gap, least);
  std::vector<Place> places;
  for (const auto& [name, gap] : gaps) {
    if (gap <= least) continue;
    const ChannelScale& scale = scales.at(name);
    const std::size_t slash = name.rfind('/');
    Place place;
    place.channel = name.substr(slash + 1);
    place.place = name.substr(0, slash);
    place.unit = scale.unit;
    place.rmse = gap * scale.sigma();
    place.noise_floor = scale.sigma();
    place.share = excess(gap, least) / whole;
    if (significance.count(name)) place.significance = significance.at(name);
    place.subsystem = subsystem_of(place, seams, options.seams);
    place.regime = regime_of(name, dependences, options.dependence.telling);
    places.push_back(std::move(place));
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.share > b.share; });
  return places;
}

}  // namespace discovery
}  // namespace anthrob
