#include "parameters.h"

#include "anthrob_config/errors.h"

namespace anthrob {
namespace driver {

namespace {

using Value = XmlRpc::XmlRpcValue;

[[noreturn]] void refuse(const std::string& key, const char* expected) {
  throw BadInput("parameter ~" + key + ": expected " + expected);
}

}  // namespace

double number_of(const std::string& key, Value value) {
  if (value.getType() == Value::TypeInt) return static_cast<int&>(value);
  if (value.getType() != Value::TypeDouble) refuse(key, "a number");
  return static_cast<double&>(value);
}

bool truth_of(const std::string& key, Value value) {
  if (value.getType() != Value::TypeBoolean) refuse(key, "true or false");
  return static_cast<bool&>(value);
}

std::string text_of(const std::string& key, Value value) {
  if (value.getType() != Value::TypeString) refuse(key, "a text");
  return static_cast<std::string&>(value);
}

}  // namespace driver
}  // namespace anthrob
