#pragma once

#include <string>

#include "robot_connection.h"

namespace anthrob {

/// The call of a service, for a thread: it may wait for ever.
/// @param name of the service, from the root
TimedCalls::Call call_of(const std::string& name, const ServiceRequest& request);

}  // namespace anthrob
