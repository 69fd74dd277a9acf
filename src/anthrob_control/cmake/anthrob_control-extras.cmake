# What of this package's libraries links no ROS, for libraries that link none either.
set(anthrob_control_CORE_LIBRARIES ${anthrob_control_LIBRARIES})
list(FILTER anthrob_control_CORE_LIBRARIES INCLUDE REGEX "anthrob_control_core(\\.[a-z]+)?$")
list(APPEND anthrob_control_CORE_LIBRARIES ${anthrob_sim_CORE_LIBRARIES})
list(REMOVE_DUPLICATES anthrob_control_CORE_LIBRARIES)
