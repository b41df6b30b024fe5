#include "topic_gaps.h"

#include <algorithm>
#include <cstdio>

#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {
namespace {

using Silence = StreamSilence::Silence;

/// "0 s to 60 s and 80 s to 120 s": what no silence covers of the time from `first` to `last`, counted from `first`.
std::string whatIsLeft(std::vector<Silence> silences, Stamp first, Stamp last) {
  std::sort(silences.begin(), silences.end(), [](const Silence& a, const Silence& b) { return a.from < b.from; });
  std::vector<std::string> parts;
  const auto add = [&](Stamp from, Stamp to) {
    if (to > from) parts.push_back(formatted("%.1f s to %.1f s", toSeconds(from - first), toSeconds(to - first)));
  };
  Stamp covered = first;
  for (const Silence& silence : silences) {
    add(covered, silence.from);
    covered = std::max(covered, silence.to);
  }
  add(covered, last);
  return parts.empty() ? "nothing" : join(parts, " and ");
}

}  // namespace

void TopicGaps::beginBag(const std::string& path, const std::vector<std::string>& topics) {
  const auto keep = [this](const Silence& ended) { bags_.back().silences.push_back(ended); };
  bags_.push_back({fileNames({path}).front(), topics, StreamSilence(topics, timeout_, keep)});
}

void TopicGaps::note(std::size_t topic, Stamp stamp) {
  Bag& bag = bags_.back();
  if (topic >= bag.topics.size() || stamp <= Stamp::zero()) return;
  bag.silence.add(topic, stamp);
  if (bag.first == Stamp::zero()) bag.first = stamp;
  bag.last = stamp;
}

std::vector<std::string> TopicGaps::sentences() const {
  std::vector<std::string> all = faults_;
  for (const Bag& bag : bags_) {
    if (bag.silences.empty()) continue;
    const auto after = [&](Stamp stamp) { return toSeconds(stamp - bag.first); };
    for (const Silence& one : bag.silences)
      all.push_back(formatted("%s: %s is silent from %.1f s to %.1f s%s", bag.name.c_str(),
                              bag.topics[one.stream].c_str(), after(one.from), after(one.to),
                              one.to >= bag.last ? ", the end" : ""));
    all.push_back(formatted("%s: used %s of %.1f s", bag.name.c_str(),
                            whatIsLeft(bag.silences, bag.first, bag.last).c_str(), after(bag.last)));
  }
  return all;
}

void TopicGaps::print() const {
  for (const std::string& sentence : sentences()) std::printf("%s\n", sentence.c_str());
}

void TopicGaps::explain(const std::function<void()>& check) const {
  try {
    check();
  } catch (const TooLittleError& error) {
    std::vector<std::string> reasons = sentences();
    reasons.insert(reasons.begin() + static_cast<std::ptrdiff_t>(faults_.size()), error.what());
    throw TooLittleError(join(reasons, "; "));
  }
}

json TopicGaps::toJson() const {
  json list = json::array();
  for (const Bag& bag : bags_)
    for (const Silence& silence : bag.silences)
      list.push_back({{"bag", bag.name},
                      {"topic", bag.topics[silence.stream]},
                      {"from", toSeconds(silence.from)},
                      {"to", toSeconds(silence.to)}});
  return list;
}

}  // namespace suspension_health_monitor
