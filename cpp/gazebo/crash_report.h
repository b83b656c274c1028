// Names the plugin whose code crashes, before the process dies as it would.
#pragma once

#include "gazebo/trundle_host.h"

namespace trundle {

// Watch for signals of faults from now on.
void install_crash_report();

// Plugin whose code runs in this thread; null: none. The text is kept.
void set_running_plugin(const char* plugin);

// Library that knows why a plugin may have crashed.
void set_crash_hint(const TrundleGazeboKit* kit);

}  // namespace trundle
