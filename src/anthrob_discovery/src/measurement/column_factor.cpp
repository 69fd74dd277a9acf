#include "measurement/column_factor.h"

#include <algorithm>
#include <cmath>

namespace anthrob {
namespace discovery {

namespace {

/// Centred sums of products.
struct ProductSums {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

  void add(double a, double b) { n += 1.0, x += a, y += b, xx += a * a, xy += a * b, yy += b * b; }
  ProductSums without(const ProductSums& o) const {
    return {n - o.n, x - o.x, y - o.y, xx - o.xx, xy - o.xy, yy - o.yy};
  }
  double own() const { return xx - x * x / n; }
  double both() const { return xy - x * y / n; }
  double other() const { return yy - y * y / n; }
  double slope() const { return both() / own(); }
};

}  // namespace

std::optional<ColumnFactor> column_factor(const std::vector<double>& expected,
                                          const std::vector<double>& recorded,
                                          const std::vector<double>& factors, double near,
                                          const ColumnOptions& options) {
  const std::size_t n = std::min(expected.size(), recorded.size());
  if (n < options.fewest_rows) return {};
  const std::size_t parts = options.blocks;
  ProductSums all;
  std::vector<ProductSums> blocks(parts);
  for (std::size_t i = 0; i < n; ++i) {
    if (!std::isfinite(expected[i]) || !std::isfinite(recorded[i])) continue;
    all.add(expected[i], recorded[i]);
    blocks[i * parts / n].add(expected[i], recorded[i]);
  }
  if (!(all.own() > 0.0) || !(all.other() > 0.0)) return {};
  const double correlated = all.both() * all.both() / (all.own() * all.other());
  const bool is_correlated = correlated > options.correlated.value;
  if (!is_correlated && !(correlated > options.hardly_correlated.value)) return {};
  ColumnFactor found;
  found.measured = all.slope();
  double square = 0.0;
  for (const ProductSums& block : blocks) {
    square += std::pow(all.without(block).slope() - found.measured, 2);
  }
  found.sigma = std::sqrt(square * (1.0 - 1.0 / static_cast<double>(parts)));
  const double size = std::abs(found.measured);
  const auto away = [&](double factor) { return std::abs(std::log(size / factor)); };
  double nearest = 1.0;
  for (const double factor : factors) {
    if (away(factor) < away(nearest)) nearest = factor;
  }
  // A narrower range says that there is nothing between the two columns that physics could change.
  const bool by_physics = near >= options.near.value;
  const bool is_large = by_physics && std::abs(std::log(nearest)) > std::log(options.large);
  const bool is_sign = nearest == 1.0 && found.measured < 0.0;
  // Physics makes neither a large factor nor another sign.
  const bool is_coarse = is_large || (by_physics && is_sign);
  if (!is_correlated && !is_coarse) return {};
  const double most = is_coarse ? std::log(options.beside_large)
                      : is_sign ? std::log(1.0 + options.near.value)
                                : std::log(1.0 + near);
  if (away(nearest) > most) return {};
  found.factor = std::copysign(nearest, found.measured);
  return found;
}

}  // namespace discovery
}  // namespace anthrob
