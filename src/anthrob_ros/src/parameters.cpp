#include "anthrob_ros/parameters.h"

#include <cmath>
#include <sstream>

#include "anthrob_core/errors.h"
#include "anthrob_core/robots.h"

namespace anthrob {

namespace {

using Value = XmlRpc::XmlRpcValue;

[[noreturn]] void refuse(const std::string& key, const Value& value, const char* expected) {
  std::ostringstream text;
  text << "parameter ~" << key << ": ";
  if (value.getType() == Value::TypeString) {
    text << "'" << static_cast<std::string>(const_cast<Value&>(value)) << "'";
  } else if (value.getType() == Value::TypeBoolean) {
    text << (static_cast<bool>(const_cast<Value&>(value)) ? "true" : "false");
  } else {
    text << value;
  }
  throw BadInput(text.str() + ": expected " + expected);
}

}  // namespace

// XmlRpc reads a value through a reference that is not const, so all take a copy.
// NOLINTBEGIN(performance-unnecessary-value-param)
double number_of(const std::string& key, Value value) {
  if (value.getType() == Value::TypeInt) return static_cast<int&>(value);
  if (value.getType() != Value::TypeDouble) refuse(key, value, "a number");
  const double number = static_cast<double&>(value);
  if (!std::isfinite(number)) refuse(key, value, "a finite number");
  return number;
}

double positive_number_of(const std::string& key, Value value) {
  const double number = number_of(key, value);
  if (!(number > 0.0)) refuse(key, value, "a number > 0");
  return number;
}

double nonnegative_number_of(const std::string& key, Value value) {
  const double number = number_of(key, value);
  if (!(number >= 0.0)) refuse(key, value, "a number >= 0");
  return number;
}

int positive_whole_number_of(const std::string& key, Value value) {
  if (value.getType() != Value::TypeInt) refuse(key, value, "a whole number");
  const int number = static_cast<int&>(value);
  if (number < 1) refuse(key, value, "a whole number >= 1");
  return number;
}

double real_time_factor_of(const std::string& key, Value value) {
  const double factor = number_of(key, value);
  if (!(factor > 0.0 && factor <= 1.0)) {
    refuse(key, value,
           "above 0 and at most 1, because faster than real time measurements come too late for a "
           "controller that does not step the simulator itself");
  }
  return factor;
}

bool truth_of(const std::string& key, Value value) {
  if (value.getType() != Value::TypeBoolean) refuse(key, value, "true or false");
  return static_cast<bool&>(value);
}

std::string text_of(const std::string& key, Value value) {
  if (value.getType() != Value::TypeString) refuse(key, value, "a text");
  return static_cast<std::string&>(value);
}

std::string required(const ros::NodeHandle& settings, const std::string& key,
                     const std::string& what) {
  std::string value;
  take(settings, key, text_of, value);
  if (value.empty()) throw BadInput("parameter ~" + key + ": missing; expected " + what);
  return value;
}

std::string required_model(const ros::NodeHandle& settings) {
  return find_model_file(required(settings, "model", "a model file, or a name such as anthrob/II"));
}

// NOLINTEND(performance-unnecessary-value-param)

}  // namespace anthrob
