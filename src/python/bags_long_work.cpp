// What src/tools/long_work.h promises, for a module of Python: signals belong to the interpreter, which turns Ctrl-C
// into KeyboardInterrupt, and progress goes to a callback instead of a bar.
#include "bags_long_work.h"

#include <algorithm>

#include "../tools/long_work.h"

namespace suspension_health_monitor {

static thread_local ToolsWork* current = nullptr;

ToolsWork::ToolsWork(LongWork& work, std::size_t bags) : work_(work), bags_(bags), before_(current) { current = this; }

ToolsWork::~ToolsWork() { current = before_; }

void ToolsWork::tellReading(std::size_t bags) {
  bags_ = bags;
  begun_ = 0;
}

void ToolsWork::update(double share) {
  if (bags_ == 0) return step();
  const auto others = static_cast<double>(std::min(begun_, bags_)) - 1.0;
  work_.update((others + share) / static_cast<double>(bags_));
}

Interruption::Interruption() = default;
Interruption::~Interruption() = default;

void Interruption::check() {
  if (current != nullptr) current->step();
}

Progress::Progress(std::string label, double total) : label_(std::move(label)), total_(total), visible_(false) {
  if (current != nullptr) current->beginBar();
}

Progress::~Progress() = default;

void Progress::clear() {}  // nothing is drawn

void Progress::update(double done) {
  if (current != nullptr && total_ > 0.0) current->update(done / total_);
}

}  // namespace suspension_health_monitor
