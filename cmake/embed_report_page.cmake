# cmake -DFOLDER=src/tools/report_page -DOUTPUT=report_template.cpp -P embed_report_page.cmake
# Puts style and scripts into the page and the page into a C++ file.

cmake_minimum_required(VERSION 3.16)
# The order of the scripts: what others use comes first.
set(scripts elements numbers theme axes plot layers heat_map drives time_view verdict ladder views tables adding page)

file(READ ${FOLDER}/page.html page)
file(READ ${FOLDER}/page.css style)
set(script)
foreach(name ${scripts})
  file(READ ${FOLDER}/${name}.js text)
  string(APPEND script "${text}\n")
endforeach()
string(REPLACE "@@style@@" "${style}" page "${page}")
string(REPLACE "@@scripts@@" "${script}" page "${page}")

file(WRITE ${OUTPUT} "#include \"tools/report_parts.h\"

namespace suspension_health_monitor {

std::string_view reportTemplate() {
  return R\"~page~(${page})~page~\";
}

}  // namespace suspension_health_monitor
")
