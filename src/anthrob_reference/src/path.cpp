#include "anthrob_reference/path.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "check.h"

namespace anthrob::reference {
namespace {

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  // Of unit vectors; exact for small angles, where the arc cosine of their product is not.
  return 2.0 * std::asin(std::min(1.0, 0.5 * (a - b).norm()));
}

// Generalised force of a unit tension along u through point p that pulls body `near` towards `far`.
Vector4 pull(const Posture& posture, Body near, Body far, const Eigen::Vector3d& p,
             const Eigen::Vector3d& u) {
  const Eigen::Vector3d moment = p.cross(u);
  return posture.generalized(near, u, moment) - posture.generalized(far, u, moment);
}

PlacedCylinder body_fixed_cylinder(const PathEntry& entry) {
  require_positive("cylinder radius", entry.cylinder->radius);
  require_positive("length of cylinder axis", entry.cylinder->axis.norm());
  return {entry.position, entry.cylinder->axis.normalized(), entry.cylinder->radius};
}

}  // namespace

Path::Path(const std::vector<PathEntry>& entries) {
  require(entries.size() >= 2, "a path of at least two points",
          static_cast<double>(entries.size()));
  const int at_ends = (entries.front().cylinder ? 1 : 0) + (entries.back().cylinder ? 1 : 0);
  require(at_ends == 0, "no cylinders at the ends of a path", at_ends);
  Span span;
  span.start = {entries.front().body, entries.front().position};
  for (std::size_t i = 1; i < entries.size(); ++i) {
    const PathEntry& entry = entries[i];
    span_of_segment_.push_back(spans_.size());
    if (entry.cylinder) {
      require(!span.wrap, "a via-point between two cylinders (index of the second one)",
              static_cast<double>(i));
      span.wrap = Wrap{entry.body, body_fixed_cylinder(entry), {}};
      continue;
    }
    span.end = {entry.body, entry.position};
    span.rigid = !span.wrap && span.start.body == span.end.body;
    if (span.rigid) span.body_fixed = straight_span(span.start.p, span.end.p);
    spans_.push_back(span);
    span = Span{};
    span.start = spans_.back().end;
  }
  find_fixed_deflections();
}

void Path::find_fixed_deflections() {
  for (std::size_t j = 0; j + 1 < spans_.size(); ++j) {
    fixed_deflections_.emplace_back();
    if (spans_[j].rigid && spans_[j + 1].rigid) {
      fixed_deflections_.back() =
          angle_between(spans_[j].body_fixed.u_end, spans_[j + 1].body_fixed.u_start);
    }
  }
}

std::size_t Path::span_of_segment(int segment) const {
  const auto count = static_cast<int>(span_of_segment_.size());
  require(segment >= 0 && segment < count, "an existing path segment", segment);
  return span_of_segment_[static_cast<std::size_t>(segment)];
}

void Path::reset_contacts(const Posture& posture) {
  for (Span& span : spans_) {
    if (span.wrap) span.wrap->memory = WrapMemory{};
  }
  update_contacts(posture);
}

void Path::update_contacts(const Posture& posture) {
  for (Span& span : spans_) {
    if (!span.wrap) continue;
    span.wrap->memory =
        next_contact(placed(*span.wrap, posture), posture.point(span.start.body, span.start.p),
                     posture.point(span.end.body, span.end.p), span.wrap->memory);
  }
}

void Path::solve(const Posture& posture, PathSolution* solution) const {
  solution->spans.resize(spans_.size());
  solution->deflections.resize(fixed_deflections_.size());
  solution->length = 0.0;
  for (std::size_t s = 0; s < spans_.size(); ++s) {
    solve_span(spans_[s], posture, &solution->spans[s]);
    solution->length += solution->spans[s].geometry.length;
  }
  for (std::size_t j = 0; j < fixed_deflections_.size(); ++j) {
    solution->deflections[j] = fixed_deflections_[j]
                                   ? *fixed_deflections_[j]
                                   : angle_between(solution->spans[j].geometry.u_end,
                                                   solution->spans[j + 1].geometry.u_start);
  }
}

double Path::penetration(const Posture& posture) const {
  double deepest = 0.0;
  for (const Span& span : spans_) {
    if (!span.wrap) continue;
    deepest = std::max(deepest, reference::penetration(placed(*span.wrap, posture),
                                                       posture.point(span.start.body, span.start.p),
                                                       posture.point(span.end.body, span.end.p)));
  }
  return deepest;
}

PlacedCylinder Path::placed(const Wrap& wrap, const Posture& posture) {
  return {posture.point(wrap.body, wrap.cylinder.origin),
          posture.frame(wrap.body).R_HX * wrap.cylinder.axis, wrap.cylinder.radius};
}

void Path::solve_span(const Span& span, const Posture& posture, SpanSolution* solution) {
  SpanGeometry& geometry = solution->geometry;
  if (span.rigid) {
    geometry = span.body_fixed;
    geometry.u_start = posture.frame(span.start.body).R_HX * span.body_fixed.u_start;
    geometry.u_end = geometry.u_start;
    solution->arm.setZero();
    return;
  }
  const Eigen::Vector3d start = posture.point(span.start.body, span.start.p);
  const Eigen::Vector3d end = posture.point(span.end.body, span.end.p);
  const bool touching = span.wrap && span.wrap->memory.side != 0;
  geometry = touching ? wrapped_span(placed(*span.wrap, posture), start, end, span.wrap->memory)
                      : straight_span(start, end);
  // A unit tension pulls the start body against whatever it meets next, and that against the end
  // body; forces within one body cancel.
  const Body between = touching ? span.wrap->body : span.end.body;
  solution->arm = pull(posture, span.start.body, between, start, geometry.u_start);
  if (between != span.end.body) {
    solution->arm += pull(posture, between, span.end.body, end, geometry.u_end);
  }
}

}  // namespace anthrob::reference
