#pragma once

#include <optional>
#include <vector>

#include "anthrob_reference/cylinder.h"
#include "anthrob_reference/parameters.h"
#include "anthrob_reference/posture.h"

namespace anthrob::reference {

/// Tendon between two neighbouring via-points, with the cylinder between them if there is one.
struct SpanSolution {
  SpanGeometry geometry;          ///< directions in the axes of Posture
  Vector4 arm = Vector4::Zero();  ///< moment arm -d length / dq [m]
};

/// Path in one posture: n spans from origin to insertion and the n - 1 eyelets between them.
struct PathSolution {
  double length = 0.0;  ///< l_M [m]
  std::vector<SpanSolution> spans;
  std::vector<double> deflections;  ///< (4.77) [rad], eyelet j between spans j and j + 1
};

/// Path of a muscle over via-points and cylinders (4.17)-(4.33).
class Path final {
 public:
  /// @throws std::invalid_argument unless it starts and ends at via-points, no two cylinders are
  ///   neighbours, and their radii and axes are positive.
  explicit Path(const std::vector<PathEntry>& entries);

  std::size_t span_count() const { return spans_.size(); }
  /// Span that holds segment k of the path entries.
  std::size_t span_of_segment(int segment) const;

  /// Forgets all contacts, then finds those of this posture.
  void reset_contacts(const Posture& posture);
  /// Contacts after a small motion to this posture.
  void update_contacts(const Posture& posture);

  /// Path with the contacts as they are remembered.
  void solve(const Posture& posture, PathSolution* solution) const;
  /// Deepest via-point inside a neighbouring cylinder [m]; more than a fraction of a millimetre
  /// means that the model has left its range.
  double penetration(const Posture& posture) const;

 private:
  struct Point {
    Body body = Body::kBase;
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
  };
  struct Wrap {
    Body body = Body::kBase;
    PlacedCylinder cylinder;  // in body axes
    WrapMemory memory;
  };
  struct Span {
    Point start;
    Point end;
    std::optional<Wrap> wrap;
    bool rigid = false;       // both ends on one body and nothing between them
    SpanGeometry body_fixed;  // if rigid: in body axes
  };

  void find_fixed_deflections();
  static PlacedCylinder placed(const Wrap& wrap, const Posture& posture);
  static void solve_span(const Span& span, const Posture& posture, SpanSolution* solution);

  std::vector<Span> spans_;
  std::vector<std::size_t> span_of_segment_;
  std::vector<std::optional<double>> fixed_deflections_;  // between two rigid spans
};

}  // namespace anthrob::reference
