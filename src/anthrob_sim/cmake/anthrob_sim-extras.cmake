# What of this package's libraries links no ROS, for libraries that link none either.
set(anthrob_sim_CORE_LIBRARIES ${anthrob_sim_LIBRARIES})
list(FILTER anthrob_sim_CORE_LIBRARIES EXCLUDE REGEX "anthrob_(sim_recordings|tool)(\\.[a-z]+)?$")
