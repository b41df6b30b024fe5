#pragma once

#include <boost/noncopyable.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "command.h"

namespace suspension_health_monitor {

/// FOLDER/report.html: one page for people that needs no other file and no network. It appears whole or not at all.
/// What a page is made of lies in report_page/; the numbers travel in it as JSON.
class HtmlPage {
 public:
  /// @param folder  made if it is not there, and taken away again if nothing is written.
  /// @throws std::runtime_error  naming the file or folder, if it cannot be written.
  explicit HtmlPage(const std::string& folder);

  /// @param page  the template, with "@@findings@@" where its JSON goes.
  /// @throws std::runtime_error  naming the file, if it cannot be written.
  void write(std::string_view page, const json& findings);

  /// @param page  the whole page.
  void write(const std::string& page) { file_.commit(page); }

 private:
  class Folder : boost::noncopyable {
   public:
    explicit Folder(const std::string& path);
    ~Folder();

   private:
    std::string path_;
    bool made_;
  };

  Folder folder_;  // before the file, so that it is empty by the time that it is taken away
  TextFile file_;
};

/// @return the page of --report, begun; nothing: it is not given.
/// @throws std::runtime_error  as HtmlPage.
std::optional<HtmlPage> reportPage(const po::variables_map& values);

/// @return a copy with numbers to five digits: a figure shows no more, and the page stays small.
json shortened(json value);

/// The pages with style and scripts in them and "@@findings@@" where their JSON goes: of a search, of health, of
/// curves. Made from report_page/ when the package is built (cmake/embed_report_page.cmake).
std::string_view searchTemplate();
std::string_view vehicleTemplate();
std::string_view healthTemplate();
std::string_view curvesTemplate();

/// The page of an inspection, without a script, with "@@...@@" where its text goes.
std::string_view inspectionTemplate();

/// @param names  of the bags.  @param duration, period  of their samples [s].
/// @return what a page was made from, in words.
std::string sourceOf(const std::vector<std::string>& names, double duration, double period);

/// What every page tells of itself: when it was made, by what, and from which topics.
/// @param values  of the command that makes it.
json originOf(const po::variables_map& values, const std::vector<std::string>& topics);

}  // namespace suspension_health_monitor
