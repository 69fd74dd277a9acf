#include "mujoco_peer.h"

#include <sstream>
#include <stdexcept>
#include <vector>

#include "anthrob_sim/spring/series_elastic_element.h"
#include "path/cylinder.h"
#include "path/sphere.h"

namespace anthrob {

namespace {

std::string text(const Vec3& v) {
  std::ostringstream out;
  out.precision(17);
  out << v.x() << " " << v.y() << " " << v.z();
  return out.str();
}

std::string text(const Mat3& R) {
  const Quat q(R);
  std::ostringstream out;
  out.precision(17);
  out << q.w() << " " << q.x() << " " << q.y() << " " << q.z();
  return out.str();
}

/// Where a muscle's path touches a body: a site for a point, a geom for a surface.
struct Element {
  std::string name;
  const PathObstacle* obstacle;
};

class Writer {
 public:
  explicit Writer(const RobotModel& model)
      : model_(model), elements_(model.skeleton->bodies.size()) {
    out_.precision(17);
    for (const MuscleModel& muscle : model.muscles) {
      int k = 0;
      for (const PathObstacle& obstacle : muscle.path->obstacles()) {
        elements_[obstacle.body].push_back({muscle.name + "_" + std::to_string(k++), &obstacle});
      }
    }
  }

  std::string write() {
    out_ << "<mujoco><compiler angle=\"radian\" inertiafromgeom=\"false\"/>\n<option timestep=\""
         << model_.step << "\" gravity=\"" << text(model_.gravity)
         << "\"><flag contact=\"disable\"/></option>\n<worldbody>\n";
    write_elements(0);
    write_children(0);
    out_ << "</worldbody>\n<tendon>\n";
    for (const MuscleModel& muscle : model_.muscles) write_tendon(muscle);
    out_ << "</tendon>\n<actuator>\n";
    for (const MuscleModel& muscle : model_.muscles) {
      out_ << "<motor tendon=\"" << muscle.name << "\" gear=\"-1\"/>\n";
    }
    out_ << "</actuator></mujoco>\n";
    return out_.str();
  }

 private:
  void write_elements(int body) {
    for (const Element& element : elements_[body]) {
      const PathObstacle& o = *element.obstacle;
      if (!o.surface) {
        out_ << "<site name=\"" << element.name << "\" pos=\"" << text(o.point_B) << "\"/>\n";
      } else if (const auto* cylinder = dynamic_cast<const Cylinder*>(o.surface.get())) {
        Mat3 z_is_axis;
        z_is_axis << Vec3::UnitX(), -Vec3::UnitZ(), Vec3::UnitY();
        out_ << "<geom name=\"" << element.name << "\" type=\"cylinder\" size=\""
             << cylinder->radius() << " 0.1\" pos=\"" << text(cylinder->pose().p) << "\" quat=\""
             << text(Mat3(cylinder->pose().R * z_is_axis)) << "\"/>\n";
      } else if (const auto* sphere = dynamic_cast<const Sphere*>(o.surface.get())) {
        out_ << "<geom name=\"" << element.name << "\" type=\"sphere\" size=\"" << sphere->radius()
             << "\" pos=\"" << text(sphere->center()) << "\"/>\n";
      }
    }
  }

  /// Body frames are the principal frames, as in the simulation.
  void write_children(int parent) {
    for (const JointModel& joint : model_.skeleton->joints) {
      if (joint.parent != parent) continue;
      const BodyModel& body = model_.skeleton->bodies[joint.child];
      const Pose X_PB =
          model_.skeleton->bodies[parent].X_LB.inverse() * joint.X_PC_rest * body.X_LB;
      out_ << "<body name=\"" << body.name << "\" pos=\"" << text(X_PB.p) << "\" quat=\""
           << text(X_PB.R) << "\">\n<inertial pos=\"0 0 0\" mass=\"" << body.mass
           << "\" diaginertia=\"" << text(body.principal) << "\"/>\n";
      const char* type = joint.type == JointType::kBall    ? "ball"
                         : joint.type == JointType::kHinge ? "hinge"
                                                           : "slide";
      out_ << "<joint type=\"" << type << "\" pos=\"" << text(body.X_LB.inverse() * joint.center_C)
           << "\" damping=\"" << joint.friction.viscous << "\"";
      if (joint.type != JointType::kBall) {
        out_ << " axis=\"" << text(Vec3(body.X_LB.R.transpose() * joint.axis_C)) << "\"";
        if (joint.stop.enabled) {
          out_ << " limited=\"true\" range=\"" << joint.stop.lower << " " << joint.stop.upper
               << "\"";
        }
      }
      out_ << "/>\n";
      write_elements(joint.child);
      write_children(joint.child);
      out_ << "</body>\n";
    }
  }

  void write_tendon(const MuscleModel& muscle) {
    const double force = muscle.spring->relaxed_tension(0.001);
    const double slack =
        muscle.spring->rest_length() + muscle.actuator->tendon_length(StateView(memory_));
    out_ << "<spatial name=\"" << muscle.name << "\" stiffness=\"" << force / 0.001
         << "\" springlength=\"" << slack << "\">\n";
    int k = 0;
    for (const PathObstacle& obstacle : muscle.path->obstacles()) {
      const std::string name = muscle.name + "_" + std::to_string(k++);
      out_ << (obstacle.surface ? "<geom geom=\"" : "<site site=\"") << name << "\"/>\n";
    }
    out_ << "</spatial>\n";
  }

  const RobotModel& model_;
  std::ostringstream out_;
  std::vector<std::vector<Element>> elements_;
  double memory_[64] = {};  ///< an actuator at rest
};

}  // namespace

std::string to_mjcf(const RobotModel& model) {
  return Writer(model).write();
}

MujocoPeer::MujocoPeer(const RobotModel& model) {
  const std::string xml = to_mjcf(model);
  mjVFS files;
  mj_defaultVFS(&files);
  mj_makeEmptyFileVFS(&files, "robot.xml", static_cast<int>(xml.size()));
  std::copy(xml.begin(), xml.end(), static_cast<char*>(files.filedata[0]));
  char error[1000] = "";
  model_.reset(mj_loadXML("robot.xml", &files, error, sizeof(error)));
  mj_deleteVFS(&files);
  if (!model_) throw std::runtime_error(std::string("MuJoCo refuses the model: ") + error);
  data_.reset(mj_makeData(model_.get()));
}

}  // namespace anthrob
