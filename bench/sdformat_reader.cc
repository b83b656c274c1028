// Reads every file named on standard input with libsdformat and prints the seconds of CPU it took: the peer of
// bench/descriptions.
#include <cstdio>
#include <ctime>
#include <iostream>
#include <string>
#include <vector>

#include <sdf/sdf.hh>

int main(int argc, char** argv) {
  const std::string models = argc > 1 ? argv[1] : "";
  sdf::Console::Instance()->SetQuiet(true);
  sdf::ParserConfig config;
  config.SetFindCallback([&](const std::string& uri) {
    const std::string scheme = "model://";
    return uri.rfind(scheme, 0) == 0 ? models + "/" + uri.substr(scheme.size()) : std::string();
  });
  std::vector<std::string> files;
  for (std::string line; std::getline(std::cin, line);) files.push_back(line);
  const std::clock_t start = std::clock();
  for (const auto& file : files) {
    sdf::Root root;
    root.Load(file, config);
  }
  std::printf("%.6f\n", static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
}
