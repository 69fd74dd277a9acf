#include "twin_messages.h"

#include "twin/samples.h"

namespace anthrob {

anthrob_msgs::MuscleStates twin_muscle_states(const Simulation& sim, bool imposed,
                                              const ros::Time& stamp) {
  anthrob_msgs::MuscleStates states;
  states.header.stamp = stamp;
  states.header.frame_id = sim.model().skeleton->bodies[0].name;
  for (int m = 0; m < static_cast<int>(sim.muscle_count()); ++m) {
    const Muscle& muscle = sim.muscle(m);
    const ecu::Measurement& measured = muscle.measured();
    states.name.push_back(muscle.model().name);
    states.position.push_back(measured.position);
    states.velocity.push_back(measured.velocity);
    states.current.push_back(imposed ? twin::kNotMeasured : measured.current);
    states.voltage.push_back(imposed ? twin::kNotMeasured : muscle.voltage());
    states.force.push_back(muscle.model().has_force_sensor() ? measured.force : twin::kNotMeasured);
    states.reference.push_back(muscle.reference());
    states.mode.push_back(static_cast<std::uint8_t>(muscle.mode()));
    states.ecu_state.push_back(muscle.enabled() ? anthrob_msgs::MuscleStates::ENABLED
                                                : anthrob_msgs::MuscleStates::STOPPING);
  }
  return states;
}

}  // namespace anthrob
