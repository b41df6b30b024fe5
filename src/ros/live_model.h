#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "shell_options.h"
#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/record/motion.h"

namespace suspension_health_monitor {

/// Which effects a live model may have, has, and where the numbers inside them come from.
class LiveModel {
 public:
  using Shapes = std::map<std::string, double>;  ///< by NAME/SHAPE, SI
  using Scale = std::function<std::optional<MotionScale>()>;

  /// Reads effects_file and model_file; a model_file that is not there yet holds nothing.
  /// @param strut  whose model it is in a model_file of all struts of a vehicle; empty: the file has one model.
  /// The model has the file's effects and those of the option `effects`.
  /// @throws std::invalid_argument  naming option or file, the value, and what is allowed.
  explicit LiveModel(const ShellOptions& options, const std::string& strut = {});

  const EffectLibrary& library() const { return library_; }

  /// What the model has: coefficients are start values.
  const std::vector<ActiveEffect>& effects() const { return effects_; }
  void setEffects(std::vector<ActiveEffect> effects) { effects_ = std::move(effects); }

  /// @return false: model_file says that its model leaves more than noise. Then health learns a baseline.
  bool isComplete() const { return !loaded_ || loaded_->is_complete; }

  /// @return what the model is, in a few words.
  std::string describe() const;

  /// @return what of model_file is not as somebody may think: that it is not there, that it has faults of a reading.
  std::vector<std::string> remarks() const;

  /// Effects by name. A shape is as given, else as the last diagnosis fitted it, else as in model_file, else as the
  /// model has it, else the middle (geometric mean) of its range for the drive's scale.
  /// @param scale  asked only for such a middle.
  /// @throws std::invalid_argument  naming what is unknown or twice, and what is allowed; a shape not known yet.
  std::vector<ActiveEffect> choose(const std::vector<std::string>& names, Shapes given, const Scale& scale) const;

  /// @return b1 and b0 that belong to effects as the last diagnosis or model_file has them, all and no other.
  std::optional<LinearStrut> strutFor(const std::vector<ActiveEffect>& effects) const;

  const std::optional<Diagnosis>& diagnosis() const { return diagnosis_; }
  void setDiagnosis(const Diagnosis& diagnosis) { diagnosis_ = diagnosis; }

  /// @return the effects that the last diagnosis found and the model does not have.
  std::vector<std::string> missing() const;

  /// Writes the model to model_file, whole or not at all; the models of other struts that it has stay.
  /// @param model  as it is now; faults of a reading stay as model_file has them. It is as complete as the
  /// last diagnosis of the same effects found it, or as model_file says.
  /// @throws std::runtime_error  naming the file that cannot be written, or the option that is not given.
  /// @throws std::invalid_argument  if the file has become none that readModelsFile() takes.
  void save(StrutModel model) const;

 private:
  std::optional<StrutModel> load() const;
  const ActiveEffect* known(const std::string& name) const;
  ActiveEffect make(const std::string& name, Shapes& given, const Scale& scale) const;

  std::string model_file_;
  std::string strut_;  // in model_file_, if it has several
  EffectLibrary library_;
  std::optional<StrutModel> loaded_;
  std::vector<ActiveEffect> effects_;
  std::optional<Diagnosis> diagnosis_;
};

/// @param monitor  nullptr: there is none.
/// @return the model as the monitor has it now; nothing: its estimate is not valid.
std::optional<StrutModel> modelOf(const SuspensionMonitor* monitor);

}  // namespace suspension_health_monitor
