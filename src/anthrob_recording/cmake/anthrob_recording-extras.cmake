# What of this package's libraries links no ROS, for libraries that link none either.
set(anthrob_recording_CORE_LIBRARIES ${anthrob_recording_LIBRARIES})
list(FILTER anthrob_recording_CORE_LIBRARIES INCLUDE REGEX "anthrob_recording_core(\\.[a-z]+)?$")
list(APPEND anthrob_recording_CORE_LIBRARIES ${anthrob_core_LIBRARIES})
list(REMOVE_DUPLICATES anthrob_recording_CORE_LIBRARIES)
