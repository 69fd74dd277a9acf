#include "report/quantities.h"

#include <algorithm>
#include <array>
#include <utility>

#include "anthrob_core/nearest_name.h"
#include "anthrob_sim/core/errors.h"

namespace anthrob {

namespace {

using ReadVector = std::function<Vec3(const Simulation& sim)>;
constexpr std::array<const char*, 3> kComponents = {"x", "y", "z"};

/// Writes the quantities of one robot one after the other.
class QuantityList {
 public:
  explicit QuantityList(const RobotModel& model) : model_(model) {}

  std::vector<Quantity> all() {
    add_whole();
    for (std::size_t j = 0; j < model_.skeleton->joints.size(); ++j) add_joint(static_cast<int>(j));
    for (std::size_t m = 0; m < model_.muscles.size(); ++m) add_muscle(static_cast<int>(m));
    return std::move(list_);
  }

 private:
  void add(const std::string& path, std::function<double(const Simulation&)> read) {
    list_.push_back({path, std::move(read)});
  }

  void add_vector(const std::string& path, const ReadVector& read) {
    for (int k = 0; k < 3; ++k) {
      add(path + "/" + kComponents[k], [read, k](const Simulation& sim) { return read(sim)[k]; });
    }
  }

  /// Sum over all muscles.
  void add_sum(const std::string& path, double (Muscle::*part)() const) {
    add(path, [part](const Simulation& sim) {
      double sum = 0.0;
      for (std::size_t m = 0; m < sim.muscle_count(); ++m)
        sum += (sim.muscle(static_cast<int>(m)).*part)();
      return sum;
    });
  }

  void add_whole() {
    add("energy/kinetic", [](const Simulation& sim) { return audit_energy(sim).kinetic; });
    add("energy/potential", [](const Simulation& sim) { return audit_energy(sim).potential; });
    add_sum("energy/elastic", &Muscle::spring_energy);
    add_sum("power/springs", &Muscle::spring_dissipation);
    add_sum("power/tendon_friction", &Muscle::friction_power);
    add("power/joints", [](const Simulation& sim) { return sim.last_step().joint_dissipation; });
  }

  void add_joint(int j) {
    const JointModel& joint = model_.skeleton->joints[j];
    add_motion(j, joint);
    const bool ball = joint.type == JointType::kBall;
    const std::string friction =
        joint.name + (joint.type == JointType::kPrismatic ? "/friction_force" : "/friction_torque");
    const ReadVector resistance = [j](const Simulation& sim) { return sim.joint_resistance(j); };
    if (ball) {
      add_vector(friction, resistance);
    } else {
      add(friction, [resistance](const Simulation& sim) { return resistance(sim)[0]; });
      add(joint.name + "/load", [j](const Simulation& sim) { return sim.joint_load(j); });
    }
    if (joint.driven)
      add(joint.name + "/effort", [j](const Simulation& sim) { return sim.joint_effort(j); });
    const std::size_t first = list_.size();
    add_vector(joint.name + "/reaction",
               [j](const Simulation& sim) { return sim.joint_reaction(j); });
    for (std::size_t i = first; i < list_.size(); ++i) list_[i].of_reactions = true;
  }

  void add_motion(int j, const JointModel& joint) {
    const auto position = static_cast<std::size_t>(joint.position_offset);
    const int velocity = joint.velocity_offset;
    if (joint.type != JointType::kBall) {
      add(joint.name + "/position",
          [position](const Simulation& sim) { return sim.configuration()[position]; });
      add(joint.name + "/velocity", [velocity](const Simulation& sim) {
        return sim.tree().velocities()[static_cast<std::size_t>(velocity)];
      });
      return;
    }
    constexpr std::array<const char*, 4> quaternion = {"w", "x", "y", "z"};
    for (std::size_t k = 0; k < quaternion.size(); ++k) {
      add(joint.name + "/position/" + quaternion[k],
          [position, k](const Simulation& sim) { return sim.configuration()[position + k]; });
    }
    add_vector(joint.name + "/velocity", [j, velocity](const Simulation& sim) -> Vec3 {
      const Eigen::Map<const Vec3> world(sim.tree().velocities().data() + velocity);
      return sim.tree().joint(j).R_WC.transpose() * world;
    });
  }

  void add_muscle(int m) {
    const MuscleModel& muscle = model_.muscles[static_cast<std::size_t>(m)];
    const auto add_own = [&](const std::string& path, double (Muscle::*read)() const) {
      add(muscle.name + path, [m, read](const Simulation& sim) { return (sim.muscle(m).*read)(); });
    };
    add_own("/length", &Muscle::length);
    for (std::size_t s = 0; s < muscle.path->segment_count(); ++s) {
      add(muscle.name + "/tension/" + std::to_string(s),
          [m, s](const Simulation& sim) { return sim.muscle(m).tension(s); });
    }
    add_own("/spring/expansion", &Muscle::expansion);
    add_own("/spring/energy", &Muscle::spring_energy);
    add_own("/spring/power", &Muscle::spring_dissipation);
    add_own("/friction_power", &Muscle::friction_power);
    add_own("/reference", &Muscle::reference);
    add_own("/voltage", &Muscle::voltage);
    add_actuator(m, muscle.name + "/actuator/position", &Actuator::Readout::position);
    add_actuator(m, muscle.name + "/actuator/velocity", &Actuator::Readout::velocity);
    add_actuator(m, muscle.name + "/actuator/current", &Actuator::Readout::current);
  }

  void add_actuator(int m, const std::string& path, double Actuator::Readout::*part) {
    add(path, [m, part](const Simulation& sim) { return sim.muscle(m).actuator().*part; });
  }

  const RobotModel& model_;
  std::vector<Quantity> list_;
};

}  // namespace

std::vector<Quantity> quantities_of(const RobotModel& model) {
  return QuantityList(model).all();
}

std::vector<Quantity> select_quantities(const std::vector<Quantity>& all,
                                        const std::vector<std::string>& paths) {
  std::vector<Quantity> chosen;
  for (const std::string& path : paths) {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const Quantity& known) { return known.path == path; });
    if (found == all.end()) {
      std::vector<std::string> known;
      for (const Quantity& quantity : all) known.push_back(quantity.path);
      const auto nearest = nearest_name(path, known);
      throw BadInput(
          "quantity '" + path + "': unknown; " +
          (nearest ? "did you mean '" + *nearest + "'?" : "a request for none lists all that are"));
    }
    chosen.push_back(*found);
  }
  return chosen;
}

}  // namespace anthrob
