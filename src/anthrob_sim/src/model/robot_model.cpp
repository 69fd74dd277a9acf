#include "anthrob_sim/model/robot_model.h"

#include "anthrob_core/errors.h"
#include "anthrob_core/nearest_name.h"
#include "anthrob_sim/actuator/actuator.h"
#include "spring/shaft_spring.h"

namespace anthrob {

void MuscleModel::transmit(const Transmission& by) {
  transmission = by;
  spring = std::make_shared<ShaftSpring>(by.stiffness, by.damping, by.backlash);
}

const GearedMotor* MuscleModel::motor() const {
  return dynamic_cast<const GearedMotor*>(actuator.get());
}

SensorsModel SensorsModel::predictable() const {
  SensorsModel quiet = *this;
  for (SensorModel* sensor :
       {&quiet.position, &quiet.velocity, &quiet.current, &quiet.force, &quiet.joint_position}) {
    sensor->noise = sensor->quantum = 0.0;
  }
  return quiet;
}

int RobotModel::find_muscle(const std::string& muscle) const {
  for (std::size_t i = 0; i < muscles.size(); ++i) {
    if (muscles[i].name == muscle) return static_cast<int>(i);
  }
  return -1;
}

int RobotModel::muscle_index(const std::string& muscle) const {
  const int index = find_muscle(muscle);
  if (index >= 0) return index;
  std::vector<std::string> names;
  for (const MuscleModel& known : muscles) names.push_back(known.name);
  throw BadInput(file + ": has no muscle '" + muscle + "'" + expected_names(muscle, names));
}

}  // namespace anthrob
