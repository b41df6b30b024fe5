#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace suspension_health_monitor {

/// Reads bytes as settings and readings of two IMUs, among them NaN, infinities, clocks that jump and effects that come
/// and go, and gives them to UniformGrid and SuspensionMonitor.
/// @throws std::logic_error  saying which law is broken: what is valid is finite, every reading is used or counted, no
/// stamp is reported twice.
void feedSampleStream(const std::uint8_t* bytes, std::size_t size);

/// Reads bytes as recorded drives without NaN, of any size, shape and period, and as a model, and gives them to
/// compare() and diagnose().
/// @throws std::logic_error  saying which law is broken: a result is finite, what is named has a model, what fails has
/// a reason.
void searchDriveRecords(const std::uint8_t* bytes, std::size_t size);

/// Takes a text as each of the YAML files that users write: settings, a model, laws of their own. What is wrong with it
/// must be refused in words.
/// @return for each kind of file "accepted" or the words.
std::string readSettingsText(const std::string& text);

}  // namespace suspension_health_monitor
