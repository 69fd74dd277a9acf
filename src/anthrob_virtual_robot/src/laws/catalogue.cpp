#include "laws/laws.h"

namespace anthrob::virtual_robot {

const std::vector<HiddenLaw>& catalogue_laws() {
  static const std::vector<HiddenLaw> laws{eyelet_friction(),     joint_coulomb(),
                                           joint_viscous(),       wrapping_surface(),
                                           spindle_growth(),      tendon_elasticity(),
                                           tendon_creep(),        second_maxwell_arm(),
                                           see_hysteresis(),      see_toe(),
                                           gear_efficiency(),     gear_backlash(),
                                           series_resistance(),   pwm_dead_zone(),
                                           supply_sag(),          winding_heating(),
                                           encoder_drift(),       force_sensor_offset(),
                                           force_sensor_gain(),   command_latency(),
                                           sensing_latency(),     payload(),
                                           cable_drag(),          gravity_tilt(),
                                           via_point_shift(),     mocap_misalignment(),
                                           mocap_delay(),         force_crosstalk(),
                                           joint_offset_torque(), joint_coulomb_asymmetric(),
                                           eyelet_presliding(),   ball_joint_load_friction(),
                                           see_mullins(),         cogging(),
                                           see_stiffening(),      motor_friction()};
  return laws;
}

}  // namespace anthrob::virtual_robot
