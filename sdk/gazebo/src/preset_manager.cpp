#include <cstdlib>
#include <set>

#include <gazebo/common/Console.hh>
#include <gazebo/physics/PhysicsEngine.hh>
#include <gazebo/physics/PresetManager.hh>

namespace gazebo {
namespace physics {

namespace {

// The name that SDF gives to a <physics> without one.
const char kDefaultName[] = "default_physics";

boost::any value_of(const std::string& key, const sdf::Param& param) {
  static const std::set<std::string> counts = {"iters", "max_contacts", "precon_iters", "island_threads"};
  const std::string text = param.GetAsString();
  if (key == "gravity" || key == "magnetic_field") {
    ignition::math::Vector3d vector;
    param.Get(vector);
    return vector;
  }
  if (text == "true" || text == "false") return text == "true";
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end) return text;
  if (counts.count(key)) return static_cast<int>(number);
  return number;
}

template <typename T>
bool write_as(const boost::any& value, sdf::Param& param) {
  const T* typed = boost::any_cast<T>(&value);
  return typed && param.Set(*typed);
}

void write_value(const std::string& key, const boost::any& value, sdf::Param& param) {
  if (const bool* flag = boost::any_cast<bool>(&value)) param.SetFromString(*flag ? "true" : "false");
  else if (!write_as<double>(value, param) && !write_as<float>(value, param) && !write_as<int>(value, param) &&
           !write_as<unsigned int>(value, param) && !write_as<std::string>(value, param) &&
           !write_as<const char*>(value, param) && !write_as<ignition::math::Vector3d>(value, param))
    gzerr << key << " of a physics profile is of a type that SDF does not have\n";
}

void write_values(const Preset& preset, const sdf::ElementPtr& parent) {
  for (sdf::ElementPtr e = parent->GetFirstElement(); e; e = e->GetNextElement()) {
    boost::any value;
    if (e->GetValue() && preset.GetParam(e->GetName(), value)) write_value(e->GetName(), value, *e->GetValue());
    write_values(preset, e);
  }
}

}  // namespace

bool Preset::GetParam(const std::string& key, boost::any& value) const {
  const auto found = values_.find(key);
  if (found == values_.end()) return false;
  value = found->second;
  return true;
}

bool Preset::SetParam(const std::string& key, const boost::any& value) {
  values_[key] = value;
  return true;
}

bool Preset::SetAllPhysicsParameters(PhysicsEnginePtr engine) const {
  bool is_set = true;
  for (const auto& pair : values_) is_set = engine->SetParam(pair.first, pair.second) && is_set;
  return is_set;
}

bool Preset::SetAllParamsFromSDF(const sdf::ElementPtr element) {
  if (!element) return false;
  for (sdf::ElementPtr e = element->GetFirstElement(); e; e = e->GetNextElement()) {
    if (e->GetValue() && !e->GetFirstElement()) SetParam(e->GetName(), value_of(e->GetName(), *e->GetValue()));
    SetAllParamsFromSDF(e);
  }
  return true;
}

bool Preset::SDF(const sdf::ElementPtr element) {
  sdf_ = element ? element->Clone() : element;
  return element != nullptr;
}

PresetManager::PresetManager(PhysicsEnginePtr engine, const sdf::ElementPtr world) : engine_(engine) {
  bool has_default = false;
  for (sdf::ElementPtr e = world ? world->FindElement("physics") : world; e; e = e->GetNextElement("physics")) {
    const std::string given = e->Get<std::string>("name");
    const std::string name = given.empty() ? kDefaultName : given;
    presets_[name] = Preset(name);
    ProfileSDF(name, e);
    const bool is_default = !has_default && e->Get<bool>("default");
    if (current_.empty() || is_default) current_ = name;  // The engine has its values.
    has_default = has_default || is_default;
  }
}

Preset* PresetManager::Find(const std::string& name) {
  const auto found = presets_.find(name);
  return found == presets_.end() ? nullptr : &found->second;
}

const Preset* PresetManager::Find(const std::string& name) const {
  return const_cast<PresetManager*>(this)->Find(name);
}

bool PresetManager::CurrentProfile(const std::string& name) {
  const Preset* preset = Find(name);
  if (!preset) return gzwarn << "there is no physics profile '" << name << "'\n", false;
  if (name == current_) return true;
  current_ = name;
  preset->SetAllPhysicsParameters(engine_);
  return true;
}

std::vector<std::string> PresetManager::AllProfiles() const {
  std::vector<std::string> names;
  for (const auto& pair : presets_) names.push_back(pair.first);
  return names;
}

bool PresetManager::CreateProfile(const std::string& name) {
  if (name.empty()) return gzwarn << "a physics profile needs a name\n", false;
  const sdf::ElementPtr element = std::make_shared<sdf::Element>();
  element->SetName("physics");
  element->AddAttribute("name", "string", name, true);
  element->AddAttribute("type", "string", engine_->GetType(), true);
  for (const char* key : {"max_step_size", "real_time_factor", "real_time_update_rate"})
    element->AddElement(key)->Set(boost::any_cast<double>(engine_->GetParam(key)));
  presets_[name] = Preset(name);
  return ProfileSDF(name, element);
}

std::string PresetManager::CreateProfile(const sdf::ElementPtr element) {
  const std::string name = element ? element->Get<std::string>("name") : std::string();
  return !name.empty() && CreateProfile(name) && ProfileSDF(name, element) ? name : std::string();
}

void PresetManager::RemoveProfile(const std::string& name) {
  if (!presets_.erase(name)) gzwarn << "there is no physics profile '" << name << "'\n";
  if (name == current_) current_.clear();
}

bool PresetManager::GetProfileParam(const std::string& name, const std::string& key, boost::any& value) const {
  const Preset* preset = Find(name);
  return preset && preset->GetParam(key, value);
}

bool PresetManager::GetCurrentProfileParam(const std::string& key, boost::any& value) const {
  return GetProfileParam(current_, key, value);
}

bool PresetManager::SetProfileParam(const std::string& name, const std::string& key, const boost::any& value) {
  Preset* preset = Find(name);
  if (!preset) return gzwarn << "there is no physics profile '" << name << "'\n", false;
  if (preset->HasParam(key)) preset->SetParam(key, value);
  else if (name != current_) return gzwarn << "physics profile '" << name << "' has no " << key << "\n", false;
  return name != current_ || engine_->SetParam(key, value);
}

bool PresetManager::SetCurrentProfileParam(const std::string& key, const boost::any& value) {
  return SetProfileParam(current_, key, value);
}

sdf::ElementPtr PresetManager::ProfileSDF(const std::string& name) const {
  const Preset* preset = Find(name);
  return preset ? preset->SDF() : sdf::ElementPtr();
}

bool PresetManager::ProfileSDF(const std::string& name, const sdf::ElementPtr element) {
  Preset* preset = Find(name);
  if (!preset || !preset->SDF(element)) return false;
  preset->SetAllParamsFromSDF(element);
  if (name == current_) preset->SetAllPhysicsParameters(engine_);
  return true;
}

void PresetManager::GenerateSDFFromPreset(const std::string& name, sdf::ElementPtr& element) const {
  const Preset* preset = Find(name);
  if (!preset) {
    gzwarn << "there is no physics profile '" << name << "'\n";
    return;
  }
  element = preset->SDF()->Clone();
  write_values(*preset, element);
}

}  // namespace physics
}  // namespace gazebo
