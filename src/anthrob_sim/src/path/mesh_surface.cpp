#include "path/mesh_surface.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "path/mesh_cache.h"
#include "path/mesh_file.h"
#include "path/selected_mesh.h"

namespace anthrob {

namespace {

/// Facets. The distances over denser hulls take seconds to find and 100 MB to keep.
constexpr int kDense = 30000;

/// Scratch memory: what survives a step is in the state.
struct Workspace {
  HullGeodesic geodesic;
  std::vector<int> strip;
};

Workspace& workspace() {
  static thread_local Workspace space;
  return space;
}

Vec3 unit_or_zero(const Vec3& v) {
  const double length = v.norm();
  return length > 0.0 ? Vec3(v / length) : Vec3(Vec3::Zero());
}

/// A strip walked from its other end.
void reverse(const ConvexHull& hull, std::vector<int>& strip) {
  std::reverse(strip.begin(), strip.end());
  for (int& h : strip) h = hull.edge(h).twin;
}

/// Gradient of the length with respect to both points, by way of the border on which the tendon
/// leans: the border turns with the points and takes along where edges cross it.
struct BorderGradient {
  Vec3 before = Vec3::Zero(), after = Vec3::Zero();

  void add(const Vec3& p, const Vec3& q, const Vec3& chi, const Vec3& point, const Vec3& edge,
           const Vec3& turn) {
    const Vec3 line = p - q;
    const double span = line.norm();
    const Vec3 x = line / span;
    const Vec3 normal = chi - chi.dot(x) * x;
    const double slope = normal.dot(edge);
    if (std::abs(slope) < 1e-12) return;
    const Vec3 arm = point - p;
    const Vec3 tilt = -(x.dot(arm) * normal + chi.dot(x) * (arm - x.dot(arm) * x)) / span;
    const double weight = -turn.dot(edge) / slope;
    before += weight * (tilt - normal);
    after -= weight * tilt;
  }
};

}  // namespace

MeshSurface::MeshSurface(std::vector<Vec3> points_B, const Vec3& chi_B,
                         std::vector<std::string> remarks)
    : hull_(std::make_shared<ConvexHull>(std::move(points_B))),
      locator_(*hull_),
      chi_(unit_or_zero(chi_B)),
      remarks_(std::move(remarks)) {
  // Ways cross a few times as many edges as the hull is facets wide; longer strips start cold.
  capacity_ = 16 + static_cast<std::size_t>(6.0 * std::sqrt(hull_->facet_count()));
}

std::shared_ptr<const WrappingSurface> MeshSurface::prepared_for(const Vec3* before,
                                                                 const Vec3* after) const {
  if (before == nullptr && after == nullptr) return nullptr;
  if (hull_->facet_count() > kDense) return nullptr;
  const HullPoint point = locator_.locate(after != nullptr ? *after : *before, 0);
  if (is_fixed(point)) return nullptr;
  auto prepared = std::make_shared<MeshSurface>(*this);
  prepared->field_ = distances_from(point);
  return prepared;
}

std::shared_ptr<const DistanceField> MeshSurface::distances_from(const HullPoint& point) const {
  {
    const std::lock_guard<std::mutex> lock(memo_->mutex);
    if (memo_->last && memo_->last->from() == point.p) return memo_->last;
  }
  auto field = std::make_shared<DistanceField>(*hull_, point.p, point.facet);
  const std::lock_guard<std::mutex> lock(memo_->mutex);
  memo_->last = field;
  return field;
}

bool MeshSurface::is_fixed(const HullPoint& point) const {
  // The search looks for ways shorter by more than this.
  return field_ && (field_->from() - point.p).norm() < 0.1 * StripSearch::kSame * hull_->size();
}

MeshSurface::Counts MeshSurface::counts(StateView state) {
  return state.as<Header>().counts;
}

void MeshSurface::initialise(const Vec3&, const Vec3&, StateView state) const {
  Workspace& space = workspace();
  space.geodesic.reserve(*hull_);
  space.strip.reserve(hull_->half_edge_count());
  state.as<Header>() = Header{};
}

void MeshSurface::wrap(const Vec3& before, const Vec3& after, StateView state,
                       WrapContact& contact) const {
  Way way;
  solve(before, after, state, way);
  if (!way.wraps && !way.before.moved && !way.after.moved) {
    const Vec3& core = hull_->core_begin();
    set_straight(before, after, core, contact);
    return;
  }
  follow(before, after, way, contact);
}

void MeshSurface::solve(const Vec3& before, const Vec3& after, StateView state, Way& way) const {
  auto& memory = state.as<Header>();
  way.before = locator_.locate(before, static_cast<int>(memory.facet_before));
  way.after = locator_.locate(after, static_cast<int>(memory.facet_after));
  memory.facet_before = way.before.facet;
  memory.facet_after = way.after.facet;
  int facet = way.before.facet;
  way.wraps = locator_.segment_enters(way.before.p, way.after.p, facet);
  if (!way.wraps) {
    memory.strip_length = 0.0;
    return;
  }
  // Towards the point that is fixed; else from the one nearer to the surface windows stay narrower.
  const bool before_fixed = is_fixed(way.before),
             after_fixed = !before_fixed && is_fixed(way.after);
  const double nearer =
      hull_->height(way.after.facet, way.after.p) - hull_->height(way.before.facet, way.before.p);
  way.reversed = before_fixed || (!after_fixed && nearer < 0.0);
  const HullPoint& source = way.reversed ? way.after : way.before;
  const HullPoint& target = way.reversed ? way.before : way.after;
  GeodesicQuery query{*hull_, source.p, target.p, false, Vec3::UnitZ()};
  if (before_fixed || after_fixed) query.field = field_.get();
  const Vec3 line = (target.p - source.p).normalized();
  const Vec3 up = chi_ - chi_.dot(line) * line;
  if (up.norm() > 1e-9) {
    query.limited = way.limited = true;
    query.up = way.up = up.normalized();
  }

  Workspace& space = workspace();
  space.geodesic.reserve(*hull_);
  space.strip.clear();
  double* stored = state.data() + kHeader;
  for (int i = 0; i < static_cast<int>(memory.strip_length); ++i) {
    space.strip.push_back(static_cast<int>(stored[i]));
  }
  if ((memory.from_after != 0.0) != way.reversed) reverse(*hull_, space.strip);
  const HullGeodesic::Outcome outcome = space.geodesic.solve(query, source.facet, space.strip);
  memory.counts.solved += 1.0;
  memory.counts.improved += outcome == HullGeodesic::Outcome::kImproved;
  memory.counts.cold += outcome == HullGeodesic::Outcome::kCold;
  memory.from_after = way.reversed;
  const bool fits = space.strip.size() <= capacity_;
  memory.strip_length = fits ? static_cast<double>(space.strip.size()) : 0.0;
  if (fits) std::copy(space.strip.begin(), space.strip.end(), stored);
}

/// From edges and crossings in the workspace to lengths and lines of action.
void MeshSurface::follow(const Vec3& before, const Vec3& after, const Way& way,
                         WrapContact& contact) const {
  const Vec3 &p = way.before.p, &q = way.after.p;
  contact = WrapContact();
  contact.touching = true;
  contact.penetration = std::max(way.before.depth, way.after.depth);
  const Workspace& space = workspace();
  const auto& crossings = space.geodesic.crossings();
  const int count = way.wraps ? static_cast<int>(space.strip.size()) : 0;
  const auto index = [&](int i) { return way.reversed ? count - 1 - i : i; };

  BorderGradient border;
  bool leans = false, started = false;
  Vec3 last = p, direction = Vec3::UnitX();
  contact.entry = way.before.moved ? p : q;
  for (int i = 0; i <= count; ++i) {
    const Vec3 here = i < count ? crossing(index(i)) : q;
    const Vec3 piece = here - last;
    const double length = piece.norm();
    (i == 0 ? contact.length_in : i < count ? contact.length_on : contact.length_out) += length;
    // Pieces between edges that meet in one corner have no direction.
    if (length > 1e-12 * hull_->size()) {
      const Vec3 ahead = piece / length;
      if (started)
        contact.turning += 2.0 * std::asin(std::min(1.0, 0.5 * (ahead - direction).norm()));
      if (!started) contact.direction_in = ahead;
      if (i > 0 && crossings[index(i - 1)].bend == TautString::Bend::kAtLimit) {
        const int h = space.strip[index(i - 1)];
        border.add(p, q, chi_, last, (hull_->to(h) - hull_->from(h)).normalized(),
                   started ? Vec3(direction - ahead) : Vec3(Vec3::Zero()));
        leans = true;
      }
      started = true;
      direction = ahead;
    }
    if (i == 0 && count > 0) contact.entry = here;
    last = here;
    if (i < count) contact.exit = here;
  }
  if (!started) contact.direction_in = direction;
  contact.direction_out = direction;
  contact.wrap_angle = contact.turning;
  contact.half_turns = static_cast<int>(contact.turning / M_PI);
  contact.pull_in = way.before.pull_back(contact.direction_in - border.before);
  contact.pull_out = way.after.pull_back(contact.direction_out + border.after);
  if (count == 0) {
    contact.exit = contact.entry;
    if (way.before.moved) std::swap(contact.length_in, contact.length_out);
  }
  // Where a pull is not along the tendon, it acts where the point is.
  if (way.before.moved || leans) {
    contact.length_on += contact.length_in;
    contact.length_in = 0.0;
    contact.entry = before;
  }
  if (way.after.moved || leans) {
    contact.length_on += contact.length_out;
    contact.length_out = 0.0;
    contact.exit = after;
  }
}

Vec3 MeshSurface::crossing(int k) const {
  const Workspace& space = workspace();
  const int h = space.strip[k];
  const double share = space.geodesic.crossings()[k].x * hull_->edge(h).inverse_length;
  return hull_->from(h) + share * (hull_->to(h) - hull_->from(h));
}

void MeshSurface::trace(const WrapContact& contact, std::vector<Vec3>& points) const {
  // Solved again, from nothing: drawing is rare, and the contact does not carry the way.
  std::vector<double> memory(state_size(), 0.0);
  const StateView state(memory.data());
  const Vec3 before = contact.entry - contact.length_in * contact.direction_in;
  const Vec3 after = contact.exit + contact.length_out * contact.direction_out;
  initialise(before, after, state);
  Way way;
  solve(before, after, state, way);
  points.push_back(contact.entry);
  const int count = way.wraps ? static_cast<int>(workspace().strip.size()) : 0;
  for (int i = 0; i < count; ++i) points.push_back(crossing(way.reversed ? count - 1 - i : i));
  points.push_back(contact.exit);
}

namespace {

constexpr const char* kKeys[] = {"chi", "scale", "offset", "part", "selection"};

/// All that a prepared surface depends on.
std::string description(const ConfigNode& node, const Pose& X_BL, const MeshFiles& files) {
  const ConfigNode file = node.at("file");
  std::ostringstream out;
  out.precision(17);
  // Remarks name the file that describes.
  out << file.file() << file.path() << "\n" << files.get(file)->stamp << "\n" << X_BL.R << X_BL.p;
  for (const char* key : kKeys) {
    if (node.has(key)) out << "\n" << key << node.at(key).to_yaml();
  }
  return out.str();
}

/// What was read when the surface was prepared, and no more: an unknown key is refused every time.
void pass_over(const ConfigNode& node) {
  for (const char* key : kKeys) {
    if (!node.has(key)) continue;
    if (!node.at(key).is_sequence()) {
      node.at(key).ignore();
      continue;
    }
    for (const ConfigNode& item : node.at(key).items()) {
      if (!item.is_map()) continue;
      for (const char* part : {"point", "normal"}) item.at(part).ignore();
    }
  }
}

}  // namespace

std::shared_ptr<const WrappingSurface> MeshSurface::load(const ConfigNode& node, const Pose& X_BL,
                                                         const MeshFiles& files) {
  static MeshCache cache;
  bool known = true;
  const auto surface = cache.get(description(node, X_BL, files), [&] {
    known = false;
    return prepare(node, X_BL, files);
  });
  if (known) pass_over(node);
  return surface;
}

std::shared_ptr<const WrappingSurface> MeshSurface::prepare(const ConfigNode& node,
                                                            const Pose& X_BL,
                                                            const MeshFiles& files) {
  const Vec3 chi = node.at("chi").as_vector3("1");
  if (!(chi.norm() > 1e-9)) node.at("chi").fail_expected("a vector that is not zero");
  MeshPoints mesh = load_mesh_points(node, files);
  for (Vec3& p : mesh.points) p = X_BL * p;
  const std::string selection = node.text_or("selection", "hull");
  if (selection != "hull" && selection != "half_space") {
    node.at("selection").fail_expected("hull or half_space");
  }
  try {
    if (selection == "half_space") {
      return std::make_shared<SelectedMesh>(mesh.points, X_BL.R * chi, mesh.remarks);
    }
    return std::make_shared<MeshSurface>(mesh.points, X_BL.R * chi, mesh.remarks);
  } catch (const std::invalid_argument& error) {
    node.at("file").fail(error.what());
  }
}

}  // namespace anthrob
