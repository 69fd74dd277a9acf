# What of this package's libraries links no ROS, for libraries that link none either.
set(anthrob_sim_CORE_LIBRARIES ${anthrob_sim_LIBRARIES})
list(FILTER anthrob_sim_CORE_LIBRARIES INCLUDE REGEX "anthrob_sim_core(\\.[a-z]+)?$")
list(APPEND anthrob_sim_CORE_LIBRARIES ${anthrob_recording_CORE_LIBRARIES} ${anthrob_ecu_LIBRARIES})
list(REMOVE_DUPLICATES anthrob_sim_CORE_LIBRARIES)
