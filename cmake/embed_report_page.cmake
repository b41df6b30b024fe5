# cmake -DFOLDER=src/tools/report_page -DOUTPUT=report_template.cpp -P embed_report_page.cmake
# Puts style and scripts into the pages and the pages into a C++ file.

cmake_minimum_required(VERSION 3.16)
# The order of the scripts: what others use comes first.
set(shared elements numbers verdict_words theme axes saving plot layers origin data)
set(searchTemplate_title "Which effect is missing?")
set(searchTemplate_scripts ${shared} heat_map drives time_zoom time_view verdict ladder views travel curves tables adding showing page)
set(vehicleTemplate_title "Which strut lacks what?")
set(vehicleTemplate_scripts ${shared} vehicle_drawing vehicle_verdict vehicle_tables showing vehicle_page)
set(healthTemplate_title "How healthy is the strut?")
set(healthTemplate_scripts ${shared} time_zoom time_window health_verdict health_course health_tables health_vehicle showing health_page)
set(curvesTemplate_title "What do damper and spring do?")
set(curvesTemplate_scripts ${shared} curves showing curves_page)

file(READ ${FOLDER}/page.html frame)
file(READ ${FOLDER}/page.css style)
set(functions)
foreach(function searchTemplate vehicleTemplate healthTemplate curvesTemplate)
  set(script)
  foreach(name ${${function}_scripts})
    file(READ ${FOLDER}/${name}.js text)
    string(APPEND script "${text}\n")
  endforeach()
  set(page "${frame}")
  string(REPLACE "@@title@@" "${${function}_title}" page "${page}")
  string(REPLACE "@@style@@" "${style}" page "${page}")
  string(REPLACE "@@scripts@@" "${script}" page "${page}")
  string(APPEND functions "std::string_view ${function}() {
  return R\"~page~(${page})~page~\";
}

")
endforeach()

file(READ ${FOLDER}/inspection.html page)
string(APPEND functions "std::string_view inspectionTemplate() {
  return R\"~page~(${page})~page~\";
}

")

file(WRITE ${OUTPUT} "#include \"tools/html_page.h\"

namespace suspension_health_monitor {

${functions}}  // namespace suspension_health_monitor
")
