# What of this package's libraries links no ROS, for libraries that link none either.
set(anthrob_calib_CORE_LIBRARIES ${anthrob_calib_LIBRARIES})
list(FILTER anthrob_calib_CORE_LIBRARIES INCLUDE REGEX "anthrob_calib_core(\\.[a-z]+)?$")
list(APPEND anthrob_calib_CORE_LIBRARIES ${anthrob_sim_CORE_LIBRARIES})
list(REMOVE_DUPLICATES anthrob_calib_CORE_LIBRARIES)
