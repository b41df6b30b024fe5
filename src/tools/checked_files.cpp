#include "checked_files.h"

#include <algorithm>

#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {
namespace {

/// @return the name of a strut, which topics begin with: "front_left_imu".
std::string nameOf(const std::string& topic) {
  std::string name = topic.substr(topic.find_first_not_of('/'));
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

/// @return " --set sprung_axis=-x ...", if all bodies, and all wheels, are mounted alike and not with z upward.
std::string axesOf(const std::vector<CheckedImu>& imus, const std::vector<BodyOverWheel>& pairs) {
  const std::string body = imus[pairs.front().body].upAxis(), wheel = imus[pairs.front().wheel].upAxis();
  std::string text;
  if (body != "z") text += " --set sprung_axis=" + body;
  if (wheel != "z") text += " --set unsprung_axis=" + wheel;
  return text;
}

bool areAlike(const std::vector<CheckedImu>& imus, const std::vector<BodyOverWheel>& pairs) {
  return std::all_of(pairs.begin(), pairs.end(), [&](const BodyOverWheel& pair) {
    return imus[pair.body].upAxis() == imus[pairs.front().body].upAxis() &&
           imus[pair.wheel].upAxis() == imus[pairs.front().wheel].upAxis();
  });
}

std::string vehicleOf(const std::vector<CheckedImu>& imus, const std::vector<BodyOverWheel>& pairs) {
  std::string body, struts;
  for (const BodyOverWheel& pair : pairs) {
    const std::string& top = imus[pair.body].topic;
    if (!pair.is_own) body = "body_imu: " + top + "\n";
    struts += "  " + nameOf(imus[pair.wheel].topic) + ": {";
    if (pair.is_own) struts += "sprung_imu: " + top + ", ";
    struts += "unsprung_imu: " + imus[pair.wheel].topic;
    struts += pair.is_own ? "}\n" : "}   # fill in: position: [x, y, z] of the strut's top from the body's IMU [m]\n";
  }
  std::string text = body + "struts:\n" + struts;
  if (!areAlike(imus, pairs))
    text += "# The IMUs are not mounted alike: give static transforms and target_frame (doc/conventions.md).\n";
  return text;
}

}  // namespace

int CheckedImu::axis() const {
  int axis = 0;
  up.cwiseAbs().maxCoeff(&axis);
  return axis;
}

std::string CheckedImu::upAxis() const { return (up[axis()] < 0.0 ? "-" : "") + std::string(1, "xyz"[axis()]); }

std::string nextCommand(const std::vector<CheckedImu>& imus, const std::vector<BodyOverWheel>& pairs,
                        const std::vector<std::string>& bags, const std::string& file) {
  const std::string begin = "suspension_bag identify " + join(bags, " ");
  if (pairs.size() > 1) return begin + " --vehicle " + file + (areAlike(imus, pairs) ? axesOf(imus, pairs) : "");
  return begin + " --sprung-topic " + imus[pairs.front().body].topic + " --unsprung-topic " +
         imus[pairs.front().wheel].topic + axesOf(imus, pairs);
}

std::string fileOf(const std::vector<CheckedImu>& imus, const std::vector<BodyOverWheel>& pairs,
                   const std::vector<std::string>& bags, const std::string& file) {
  const std::string head = "# suspension_bag check has found this.\n# " + nextCommand(imus, pairs, bags, file) + "\n";
  if (pairs.size() > 1) return head + vehicleOf(imus, pairs);
  const CheckedImu &body = imus[pairs.front().body], &wheel = imus[pairs.front().wheel];
  return head + "# roslaunch suspension_health_monitor monitor.launch config:=" + file + " sprung_imu:=" + body.topic +
         " unsprung_imu:=" + wheel.topic + "\nsprung_axis: \"" + body.upAxis() + "\"\nunsprung_axis: \"" +
         wheel.upAxis() + "\"\n";
}

}  // namespace suspension_health_monitor
