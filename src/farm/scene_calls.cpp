// SPDX-License-Identifier: Apache-2.0
#include "farm/scene_calls.h"

namespace oriel::farm {
namespace {

class CallVisitor {
 public:
  explicit CallVisitor(const std::function<void(const scene::ShaderUse&)>& visit) : visit_(visit) {}

  void operator()(const scene::Options& e) const { list(e.state); }
  void operator()(const scene::Camera& e) const {
    for (const scene::ShaderList* shaders : {&e.lens, &e.volume, &e.environment}) list(*shaders);
    for (const scene::Output& output : e.outputs) list(output.shaders);
  }
  void operator()(const scene::Light& e) const { list(e.shaders), list(e.emitters); }
  void operator()(const scene::Material& e) const {
    list(e.shaders);
    for (const scene::Material::Slot& slot : e.slots) list(slot.shaders);
  }
  void operator()(const scene::Texture& e) const { list(e.procedure); }
  void operator()(const scene::Instance& e) const { list(e.geometry), list(e.transform_shaders); }
  void operator()(const scene::ShaderElement& e) const { list(e.functions); }
  void operator()(const scene::Phenomenon& e) const {
    for (const auto& part : e.shaders) (*this)(part);
    for (const auto& part : e.materials) (*this)(part);
    for (const auto& part : e.lights) (*this)(part);
    for (const auto& part : e.instances) (*this)(part);
    for (const auto& root : e.roots) list(root.shaders);
  }
  template <class Other>
  void operator()(const Other&) const {}  // has no shaders

 private:
  void list(const scene::ShaderList& shaders) const {
    for (const scene::ShaderUse& use : shaders) visit_(use);
  }
  const std::function<void(const scene::ShaderUse&)>& visit_;
};

}  // namespace

void each_call(const scene::Scene& scene,
               const std::function<void(const scene::ShaderUse&)>& visit) {
  const CallVisitor visitor(visit);
  for (const scene::Element& element : scene.elements()) std::visit(visitor, element);
  for (const scene::Phenomenon& phenomenon : scene.phenomena) visitor(phenomenon);
}

}  // namespace oriel::farm
