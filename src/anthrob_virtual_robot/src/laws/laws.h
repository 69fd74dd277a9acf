#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "hidden_law.h"
#include "places.h"

namespace anthrob::virtual_robot {

// One file a law; catalogue.cpp lists them.
#define ANTHROB_LAW(name) HiddenLaw name()
ANTHROB_LAW(ball_joint_load_friction);
ANTHROB_LAW(cable_drag);
ANTHROB_LAW(cogging);
ANTHROB_LAW(command_latency);
ANTHROB_LAW(encoder_drift);
ANTHROB_LAW(eyelet_friction);
ANTHROB_LAW(eyelet_presliding);
ANTHROB_LAW(force_crosstalk);
ANTHROB_LAW(force_sensor_gain);
ANTHROB_LAW(force_sensor_offset);
ANTHROB_LAW(gear_backlash);
ANTHROB_LAW(gear_efficiency);
ANTHROB_LAW(gravity_tilt);
ANTHROB_LAW(joint_coulomb);
ANTHROB_LAW(joint_coulomb_asymmetric);
ANTHROB_LAW(joint_offset_torque);
ANTHROB_LAW(joint_viscous);
ANTHROB_LAW(mocap_delay);
ANTHROB_LAW(mocap_misalignment);
ANTHROB_LAW(motor_friction);
ANTHROB_LAW(payload);
ANTHROB_LAW(pwm_dead_zone);
ANTHROB_LAW(second_maxwell_arm);
ANTHROB_LAW(see_hysteresis);
ANTHROB_LAW(see_mullins);
ANTHROB_LAW(see_stiffening);
ANTHROB_LAW(see_toe);
ANTHROB_LAW(sensing_latency);
ANTHROB_LAW(series_resistance);
ANTHROB_LAW(spindle_growth);
ANTHROB_LAW(supply_sag);
ANTHROB_LAW(tendon_creep);
ANTHROB_LAW(tendon_elasticity);
ANTHROB_LAW(via_point_shift);
ANTHROB_LAW(winding_heating);
ANTHROB_LAW(wrapping_surface);
#undef ANTHROB_LAW

/// A law of one muscle, at each muscle of the place.
template <class Make>
void add_to_muscles(const Hidden& hidden, Draft* draft, const Make& make) {
  for (const std::size_t i : draft->muscles(hidden.place)) {
    draft->muscle_laws.emplace_back(i, make(draft->arm.muscles[i]));
  }
}

/// Stiffness of a muscle's rings at rest, after relaxation [N/m].
inline double ring_stiffness(const reference::RingParameters& ring) {
  return ring.quantity * ring.strands * M_PI / 4.0 * ring.section_diameter * ring.section_diameter *
         ring.modulus / ring.rest_length;
}

inline bool is_shoulder(const std::string& place) {
  return place == "shoulder";
}

}  // namespace anthrob::virtual_robot
