#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

// "friction (or digressive_damping)": what the drives cannot tell from it, too.
std::string namesOf(const Diagnosis& strut) {
  std::string text = join(strut.selected, " and ");
  for (const std::vector<std::string>& group : strut.indistinguishable) {
    std::vector<std::string> rivals;
    for (const std::string& name : group)
      if (std::find(strut.selected.begin(), strut.selected.end(), name) == strut.selected.end()) rivals.push_back(name);
    if (!rivals.empty()) text += " (or " + join(rivals, " or ") + ")";
  }
  return text;
}

}  // namespace

std::string whyNotCoupled(const std::optional<StrutPair>& most_alike, const std::vector<std::string>& struts) {
  if (!most_alike)
    return "are too short or too calm to tell how the struts move one another, or something else than the wheels moves "
           "the body: check which IMU is on the body and which on a wheel, and that their axes point up";
  return "cannot tell " + struts[most_alike->first] + " from " + struts[most_alike->second] +
         ": their wheels move alike, or too little. Drive over bumps on one side";
}

std::string describe(InertiaDoubt doubt) {
  const std::string begin = "cannot tell M/Iyy and M/Ixx: ";
  switch (doubt) {
    case InertiaDoubt::kNone: return "";
    case InertiaDoubt::kNoPositions: return begin + "a strut has no position";
    case InertiaDoubt::kOnOneLine: return begin + "it takes three struts that do not stand on one line";
    case InertiaDoubt::kUncertain: return begin + "the rows are too uncertain, or do not fit the positions";
  }
  return "";
}

std::string describe(const BodyLevel& level) {
  if (!level.isTurned()) return "";
  const double degrees = level.lean() / M_PI * 180.0;
  return "the body's IMU leans by " + std::to_string(std::lround(degrees)) +
         " degrees: gravity tells which way is up; positions are in its own axes";
}

std::string summaryOf(const VehicleDiagnosis& diagnosis, const std::vector<std::string>& struts) {
  std::vector<std::string> missing, suspects, unexplained, silent;
  for (std::size_t i = 0; i < struts.size(); ++i) {
    const Diagnosis& strut = diagnosis.struts[i];
    if (!strut)
      silent.push_back(struts[i]);
    else if (strut.verdict == Verdict::kEffectFound)
      missing.push_back(namesOf(strut) + " in " + struts[i]);
    else if (strut.verdict == Verdict::kSuspect)
      suspects.push_back(namesOf(strut) + " in " + struts[i]);
    else if (strut.verdict == Verdict::kUnexplained)
      unexplained.push_back(struts[i]);
  }
  for (const AntiRollBarFound& bar : diagnosis.coupling.bars)
    missing.push_back(std::string(kAntiRollBar) + " between " + struts[bar.first] + " and " + struts[bar.second]);
  std::vector<std::string> sentences;
  if (!missing.empty()) sentences.push_back("Missing from the model: " + join(missing) + ".");
  if (!suspects.empty()) sentences.push_back("Main suspect: " + join(suspects) + ".");
  if (!unexplained.empty())
    sentences.push_back("Something that no known effect explains is " +
                        (sentences.empty() ? "missing in " + join(unexplained) + "."
                                           : "left in " + join(unexplained) +
                                                 ": missing there, or carried over from the strut that lacks more."));
  if (!silent.empty()) sentences.push_back("Nothing can be said of " + join(silent) + ".");
  if (sentences.empty()) return "Nothing is missing in any strut: what the models leave is noise.";
  return join(sentences, " ");
}

}  // namespace suspension_health_monitor
