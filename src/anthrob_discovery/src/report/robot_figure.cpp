#include "report/robot_figure.h"

#include <algorithm>
#include <cstdio>
#include <memory>

#include "anthrob_core/text.h"
#include "anthrob_sim/effects/placed_effects.h"
#include "anthrob_sim/simulation.h"

namespace anthrob {
namespace discovery {

namespace {

/// Of one view [px].
struct ViewSize {
  double width = 450, height = 380, rim = 40;
};
const ViewSize view_size;

enum class Part { kBone, kMuscle, kMarkedBone, kMarkedMuscle };

struct Stroke {
  Part part;
  std::vector<Vec3> points_W;  ///< [m]
};

struct Mark {
  Vec3 point_W;  ///< [m]
  std::string label;
};

struct Drawing {
  std::vector<Stroke> strokes;
  std::vector<Mark> marks;
};

/// Whether the first word of a place, or both of `TO/FROM`, is this name.
bool is_marked(const std::string& name, const std::vector<std::string>& places) {
  return std::any_of(places.begin(), places.end(), [&](const std::string& place) {
    const auto words = split_place(place);
    return words[0] == name || (words.size() == 2 && words[1] == name);
  });
}

/// The entry of the path that a place `MUSCLE/k` or `MUSCLE/k/x` names; -1: none.
int entry_of(const std::string& place, const std::string& muscle) {
  const auto words = split_place(place);
  if (words.size() < 2 || words[0] != muscle) return -1;
  int entry = -1;
  return std::sscanf(words[1].c_str(), "%d", &entry) == 1 ? entry : -1;
}

/// The point of a leaf's bone that lies farthest from its joint: where muscles hold it, or its
/// centre of mass.
Vec3 tip_of(const Simulation& sim, int body, const Vec3& joint_W) {
  const Pose& X_WB = sim.bodies()[static_cast<std::size_t>(body)].X_WB;
  Vec3 tip = X_WB.p;
  for (std::size_t m = 0; m < sim.model().muscles.size(); ++m) {
    for (const PathObstacle& obstacle :
         sim.muscle(static_cast<int>(m)).path().model().obstacles()) {
      if (obstacle.body != body || obstacle.surface) continue;
      const Vec3 point_W = X_WB * obstacle.point_B;
      if ((point_W - joint_W).norm() > (tip - joint_W).norm()) tip = point_W;
    }
  }
  return tip;
}

void draw_bones(const Simulation& sim, const std::vector<std::string>& places, Drawing& drawing) {
  const SkeletonModel& skeleton = *sim.model().skeleton;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const JointModel& joint = skeleton.joints[j];
    const Vec3& center_W = sim.tree().joint(static_cast<int>(j)).center_W;
    const std::string& name = skeleton.bodies[static_cast<std::size_t>(joint.child)].name;
    const bool marked = is_marked(name, places);
    const Part part = marked ? Part::kMarkedBone : Part::kBone;
    bool leaf = true;
    for (std::size_t k = 0; k < skeleton.joints.size(); ++k) {
      if (skeleton.joints[k].parent != joint.child) continue;
      leaf = false;
      drawing.strokes.push_back({part, {center_W, sim.tree().joint(static_cast<int>(k)).center_W}});
    }
    if (leaf) drawing.strokes.push_back({part, {center_W, tip_of(sim, joint.child, center_W)}});
    const auto& bone = drawing.strokes.back().points_W;
    if (marked) drawing.marks.push_back({0.5 * (bone[0] + bone[1]), name});
    if (is_marked(joint.name, places)) drawing.marks.push_back({center_W, joint.name});
  }
}

void draw_muscles(const Simulation& sim, const std::vector<std::string>& places, Drawing& drawing) {
  for (std::size_t m = 0; m < sim.model().muscles.size(); ++m) {
    const MusclePath& path = sim.muscle(static_cast<int>(m)).path();
    const std::string& name = sim.model().muscles[m].name;
    const bool marked = is_marked(name, places);
    drawing.strokes.push_back(
        {marked ? Part::kMarkedMuscle : Part::kMuscle, path.polyline(sim.bodies())});
    if (!marked) continue;
    const auto& line = drawing.strokes.back().points_W;
    Mark mark{line[line.size() / 2], name};
    for (const std::string& place : places) {
      const int entry = entry_of(place, name);
      for (const PathObstacle& obstacle : path.model().obstacles()) {
        if (entry < 0 || obstacle.entry != entry) continue;
        const Pose& X_WB = sim.bodies()[static_cast<std::size_t>(obstacle.body)].X_WB;
        mark = {X_WB * obstacle.point_B, place};
      }
    }
    drawing.marks.push_back(std::move(mark));
  }
}

/// From metres to the page; the same scale in both views.
struct View {
  int across;     ///< axis of the world that goes to the right
  double left;    ///< of the view [px]
  Vec3 middle_W;  ///< [m]
  double scale;   ///< [px/m]

  std::string at(const Vec3& p_W, const char* separator) const {
    char text[64];
    std::snprintf(text, sizeof(text), "%.1f%s%.1f",
                  left + 0.5 * view_size.width + scale * (p_W[across] - middle_W[across]),
                  separator, 0.5 * view_size.height - scale * (p_W[2] - middle_W[2]));
    return text;
  }
};

std::string stroke_svg(const Stroke& stroke, const View& view) {
  static const char* const classes[] = {"bone", "muscle", "bone marked", "muscle marked"};
  std::string out =
      std::string("<path class=\"") + classes[static_cast<int>(stroke.part)] + "\" d=\"";
  for (std::size_t i = 0; i < stroke.points_W.size(); ++i) {
    out += (i == 0 ? "M" : "L") + view.at(stroke.points_W[i], " ");
  }
  return out + "\"/>\n";
}

std::string mark_svg(const Mark& mark, const View& view) {
  return "<circle class=\"mark\" r=\"6\" cx=\"" + view.at(mark.point_W, "\" cy=\"") + "\"/>\n" +
         "<text dx=\"10\" dy=\"-6\" x=\"" + view.at(mark.point_W, "\" y=\"") + "\">" +
         escaped(mark.label) + "</text>\n";
}

std::string view_svg(const Drawing& drawing, const View& view) {
  std::string out;
  for (const Part part : {Part::kBone, Part::kMarkedBone, Part::kMuscle, Part::kMarkedMuscle}) {
    for (const Stroke& stroke : drawing.strokes) {
      if (stroke.part == part) out += stroke_svg(stroke, view);
    }
  }
  for (const Mark& mark : drawing.marks) out += mark_svg(mark, view);
  char text[160];
  std::snprintf(text, sizeof(text),
                "<text class=\"axes\" x=\"%.0f\" y=\"%.0f\">%c to the right, z up</text>\n",
                view.left + 10, view_size.height - 8, "xy"[view.across]);
  return out + text;
}

}  // namespace

std::string robot_figure(const RobotModel& robot, const std::vector<std::string>& places) {
  const Simulation sim(std::make_shared<RobotModel>(robot));
  Drawing drawing;
  draw_bones(sim, places, drawing);
  draw_muscles(sim, places, drawing);
  Eigen::AlignedBox3d box;
  for (const Stroke& stroke : drawing.strokes) {
    for (const Vec3& point : stroke.points_W) box.extend(point);
  }
  if (box.isEmpty() || box.diagonal().norm() < 1e-6) return "";
  const double wide = std::max({box.sizes()[0], box.sizes()[1], 1e-9}),
               high = std::max(box.sizes()[2], 1e-9);
  const double scale = std::min((view_size.width - 2.0 * view_size.rim) / wide,
                                (view_size.height - 2.0 * view_size.rim) / high);
  char size[96];
  std::snprintf(size, sizeof(size), "viewBox=\"0 0 %.0f %.0f\" width=\"%.0f\" height=\"%.0f\"",
                2.0 * view_size.width, view_size.height, 2.0 * view_size.width, view_size.height);
  return std::string("<svg xmlns=\"http://www.w3.org/2000/svg\" ") + size +
         " font-family=\"sans-serif\" font-size=\"13\">\n"
         "<style>.bone{stroke:#c9c2b4;stroke-width:9;stroke-linecap:round;fill:none}"
         ".muscle{stroke:#4a7ba6;stroke-width:1.3;fill:none}"
         ".marked{stroke:#d62728}.muscle.marked{stroke-width:3}"
         ".mark{fill:none;stroke:#d62728;stroke-width:2.5}.axes{fill:#777;font-size:11px}</style>\n"
         "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" +
         view_svg(drawing, {0, 0.0, box.center(), scale}) +
         view_svg(drawing, {1, view_size.width, box.center(), scale}) + "</svg>\n";
}

}  // namespace discovery
}  // namespace anthrob
