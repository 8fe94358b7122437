// SPDX-License-Identifier: Apache-2.0
// C structures of tags: camera, options, lights, instances, materials, shader calls.
#include <algorithm>
#include <cstring>

#include "runtime/texture_node.h"
#include "scene/element_settings.h"
#include "sdk/call.h"
#include "sdk/current.h"
#include "sdk/frame_buffers.h"
#include "sdk/geometry_work.h"
#include "sdk/host.h"
#include "sdk/made_parts.h"
#include "sdk/made_record.h"
#include "sdk/picture.h"
#include "sdk/query_elements.h"
#include "sdk/user_data.h"

namespace oriel::sdk {
namespace {

void store(miMatrix to, const Mat4& from) { std::memcpy(to, from.getValue(), sizeof(miMatrix)); }
miColor color(const Rgba& c) { return {c.r, c.g, c.b, c.a}; }
miUchar bits(unsigned visibility, unsigned casts, unsigned receives) {
  return static_cast<miUchar>(((visibility & casts) ? 1 : 0) | ((visibility & receives) ? 2 : 0));
}

miCamera camera_of(const World& world, const scene::Camera* written) {
  const Camera& c = world.camera;
  miCamera out = {};
  out.orthographic = c.orthographic;
  out.focal = c.focal;
  out.aperture = c.aperture;
  out.aspect = c.aspect;
  out.clip = {c.clip_near, c.clip_far};
  out.x_resolution = c.width;
  out.y_resolution = c.height;
  out.window = {c.window[0], c.window[1], c.window[2], c.window[3]};
  out.x_offset = c.offset.x;
  out.y_offset = c.offset.y;
  out.buffertag = make_tag(TagKind::Camera, 0);
  if (written) {
    const scene::CameraSettings settings = settings_of(*written);
    out.frame = settings.frame;
    out.frame_time = settings.frame_time;
    out.frame_field = settings.frame_field;
  }
  return out;
}

void store_photons(const scene::PhotonOptions& from, miBoolean& on, int& accuracy, float& radius,
                   miColor& scale) {
  on = from.on;
  accuracy = from.accuracy;
  radius = from.radius;
  scale = color(from.scale);
}

char letter_of(scene::ShadowMode mode) {
  switch (mode) {
    case scene::ShadowMode::Off:
      return 0;
    case scene::ShadowMode::Simple:
      return 1;
    case scene::ShadowMode::Sort:
      return 'l';
    case scene::ShadowMode::Segments:
      return 's';
  }
  return 1;
}

miOptions options_of(const World& world) {
  const scene::RenderOptions& o = world.options;
  miOptions out = {};
  out.trace = o.trace;
  out.motion = o.motion.on;
  out.reflection_depth = o.trace_depth.reflection;
  out.refraction_depth = o.trace_depth.refraction;
  out.trace_depth = o.trace_depth.sum;
  out.min_samples = o.samples_min;
  out.max_samples = o.samples_max;
  out.contrast = color(o.contrast);
  out.time_contrast = color(o.time_contrast);
  store_photons(o.caustic, out.caustic, out.caustic_accuracy, out.caustic_radius,
                out.caustic_scale);
  store_photons(o.globillum, out.globillum, out.globillum_accuracy, out.globillum_radius,
                out.globillum_scale);
  miBoolean volume_photons = miFALSE;
  store_photons(o.photonvol, volume_photons, out.photonvol_accuracy, out.photonvol_radius,
                out.photonvol_scale);
  out.caustic_filter_const = o.caustic.filter_constant;
  out.filter_size_x = o.filter.width;
  out.filter_size_y = o.filter.height;
  out.jitter = o.jitter;
  out.shutter = o.motion.shutter;
  out.shutter_delay = o.motion.delay;
  int buffers = static_cast<int>(std::max(o.frame_buffers.size(), world.user_buffers.size()));
  for (const UserBuffer& buffer : world.user_buffers)
    if (buffer.number < kFirstNamedBuffer) buffers = std::max(buffers, buffer.number + 1);
  out.no_images = miRC_IMAGE_USER + buffers;
  out.finalgather = o.finalgather.on ? (o.finalgather.fast_lookup ? 'f' : 1) : 0;
  out.finalgather_rays = o.finalgather.rays;
  out.finalgather_maxradius = o.finalgather.max_radius;
  out.finalgather_minradius = o.finalgather.min_radius;
  out.finalgather_view = o.finalgather.radius_in_pixels;
  out.finalgather_filter = static_cast<miUchar>(std::clamp(o.finalgather.filter, 0, 255));
  const auto depth = o.finalgather.depth.value_or(scene::FinalGatherOptions::Depth{});
  const auto small = [](int v) { return static_cast<miUint1>(std::clamp(v, 0, 255)); };
  out.fg_reflection_depth = small(depth.reflection);
  out.fg_refraction_depth = small(depth.refraction);
  out.fg_diffuse_depth = small(depth.diffuse);
  out.fg_trace_depth = small(depth.sum);
  out.fg_falloff_start = o.finalgather.falloff_start;
  out.fg_falloff_stop = o.finalgather.falloff_stop;
  out.finalgather_scale = color(o.finalgather.scale);
  out.finalgather_sec_scale = color(o.finalgather.secondary_scale);
  out.shadow = letter_of(o.shadow);
  out.face = o.face == scene::Face::Front ? 'f' : o.face == scene::Face::Back ? 'b' : 'a';
  out.render_space = o.space == scene::Space::Camera  ? 'c'
                     : o.space == scene::Space::Mixed ? 'm'
                                                      : 'o';
  out.visible_lights = world.has_area_lights;
  out.photon_reflection_depth = o.photon_depth.reflection;
  out.photon_refraction_depth = o.photon_depth.refraction;
  out.photon_trace_depth = o.photon_depth.sum;
  out.no_lens = !o.lens, out.no_volume = !o.volume, out.no_geometry = !o.geometry;
  out.no_displace = !o.displace, out.no_output = !o.output, out.no_merge = !o.merge;
  out.no_hair = !o.hair, out.no_pass = !o.pass;
  out.autovolume = o.autovolume, out.photon_autovolume = o.photon_autovolume;
  out.photonmap_only = o.photonmap_only;
  out.desaturate = o.desaturate, out.dither = o.dither, out.nopremult = !o.premultiply;
  out.gamma = o.gamma;
  out.luminance_weight = {o.luminance_weight[0], o.luminance_weight[1], o.luminance_weight[2], 0};
  out.maxdisplace = o.max_displace;
  out.string_options = make_tag(TagKind::Options, 0);
  return out;
}

void store_shape(const Light& light, miLight& out) {
  const auto local = [&](const Vec3& v) { return as_c(transform_vector(v, light.to_local)); };
  switch (light.shape) {
    case LightShape::Rectangle:
      out.area = miLIGHT_RECTANGLE;
      out.primitive.rectangle.edge_u = local(light.edge_u);
      out.primitive.rectangle.edge_v = local(light.edge_v);
      break;
    case LightShape::Disc:
      out.area = miLIGHT_DISC;
      out.primitive.disc.normal = local(light.direction);
      out.primitive.disc.radius = light.radius;
      break;
    case LightShape::Sphere:
      out.area = miLIGHT_SPHERE;
      out.primitive.sphere.radius = light.radius;
      break;
    case LightShape::Cylinder:
      out.area = miLIGHT_CYLINDER;
      out.primitive.cylinder.axis = local(light.edge_u);
      out.primitive.cylinder.radius = light.radius;
      break;
    default:
      out.area = light.placed_by_shader ? miLIGHT_USER : miLIGHT_NONE;
  }
}

miLight light_of(const Light& light, Host& host) {
  miLight out = {};
  out.type = light.shape == LightShape::Directional ? miLIGHT_DIRECTION
             : light.spread >= -1                   ? miLIGHT_SPOT
                                                    : miLIGHT_ORIGIN;
  store_shape(light, out);
  out.exponent = light.exponent;
  const auto limited = [](std::uint64_t n) {
    return static_cast<int>(std::min<std::uint64_t>(n, 0x7fffffff));
  };
  out.global_store_photons = limited(light.photons.global.store);
  out.global_emit_photons = limited(light.photons.global.emit);
  out.caustic_store_photons = limited(light.photons.caustic.store);
  out.caustic_emit_photons = limited(light.photons.caustic.emit);
  out.photons_only = light.photons.only;
  if (light.photons.emission.energy) out.energy = as_c(*light.photons.emission.energy, 1);
  out.shader = host.tag_of(light.shader);
  out.origin = as_c(transform_point(light.position, light.to_local));
  out.direction = as_c(normalize(transform_vector(light.direction, light.to_local)));
  out.spread = light.spread;
  out.samples_u = out.samples_v = 1;
  out.visible = light.visible;
  return out;
}

void place(miInstance& out, const Mat4& to_local, const Mat4& to_world) {
  store(out.tf.global_to_local, to_local);
  store(out.tf.local_to_global, to_world);
  out.tf.identity = to_world == Mat4();
  store(out.motion_transform, Mat4());
  out.gen_motion = miFALSE;
}

miInstance instance_of(const InstanceData& from, miTag object, Host& host) {
  miInstance out = {};
  place(out, from.to_object, from.to_world);
  out.item = object;
  out.parent = make_tag(TagKind::Root, 0);
  if (!from.materials.empty())
    out.material =
        host.tag_of(&host.world()->materials[static_cast<std::size_t>(from.materials.front())]);
  out.mtl_array_size = static_cast<int>(from.materials.size());
  const unsigned t = from.visibility;
  out.visible = miTRUE;
  out.shadow = static_cast<miUchar>(from.receives_shadow ? 3 : 1);
  out.reflection = bits(t, kSendsReflections, kSendsReflections);
  out.refraction = bits(t, kSendsRefractions, kSendsRefractions);
  out.transparency = bits(t, kSendsTransparency, kSendsTransparency);
  out.finalgather = bits(t, kSendsGatherRays, kSendsGatherRays);
  out.caustic = bits(t, kCastsCaustics, kReceivesCaustics);
  out.globillum = bits(t, kCastsGlobillum, kReceivesGlobillum);
  out.face = 'a';
  out.exclusive = from.lights_exclusive;
  return out;
}

miTag first_of(Host& host, const NodeList& list) {
  return list.empty() ? miNULLTAG : host.tag_of(list.front());
}

miMaterial material_of(const Material& from, Host& host) {
  miMaterial out = {};
  out.opaque = from.opaque;
  out.shader = first_of(host, from.surface);
  out.displace = first_of(host, from.displace);
  out.shadow = first_of(host, from.shadow.empty() ? from.shadow_surface : from.shadow);
  out.environment = first_of(host, from.environment);
  return out;
}

/// A built-in shader: its parameters are not a C struct.
miFunction foreign_function(const ShaderNode& node) {
  miFunction out = {};
  out.type = miFUNCTION_C;
  out.result_size = static_cast<int>(c_size(node.spec().result));
  return out;
}

}  // namespace

Host::Record Host::make(miTag tag) {
  const auto record = []<class T>(const T& value) {
    Record r{std::make_unique<std::byte[]>(sizeof(T)), sizeof(T)};
    std::memcpy(r.bytes.get(), &value, sizeof(T));
    return r;
  };
  const auto filled = [](const auto& fill) {
    Record r;
    r.bytes = fill(r.size);
    return r;
  };
  switch (kind_of(tag)) {
    case TagKind::Camera:
      return record(camera_of(*world_, scene_camera(*this)));
    case TagKind::Options:
      return record(options_of(*world_));
    case TagKind::CameraInstance: {
      miInstance out = {};
      place(out, world_->camera.to_camera, world_->camera.to_world);
      out.item = make_tag(TagKind::Camera, 0);
      return record(out);
    }
    case TagKind::Light:
      if (const int i = light(tag); i >= 0) {
        miLight out = light_of(world_->lights[static_cast<std::size_t>(i)], *this);
        out.userdata = data_of(*this, tag);
        store_written(*this, tag, out);
        return record(out);
      }
      break;
    case TagKind::LightInstance:
      if (const int i = light(tag); i >= 0) {
        const Light& l = world_->lights[static_cast<std::size_t>(i)];
        miInstance out = {};
        place(out, l.to_local, l.to_world);
        out.item = make_tag(TagKind::Light, static_cast<std::size_t>(i));
        out.userdata = data_of(*this, tag);
        return record(out);
      }
      break;
    case TagKind::Instance:
      if (const InstanceData* i = instance(tag)) {
        miInstance out = instance_of(*i, make_tag(TagKind::Object, index_of(tag)), *this);
        out.userdata = data_of(*this, tag);
        out.label = label_of(*this, tag);
        return record(out);
      }
      break;
    case TagKind::Material:
      if (const Material* m = material(tag)) return record(material_of(*m, *this));
      break;
    case TagKind::Function:
      if (const ShaderNode* n = node(tag)) return record(foreign_function(*n));
      break;
    case TagKind::UserData:
      if (const scene::UserData* data = user_data(tag))
        return filled([&](std::size_t& size) { return user_data_record(*data, *this, size); });
      break;
    case TagKind::Text: {
      const std::string_view s = text(tag);
      if (!s.data()) break;
      Record r{std::make_unique<std::byte[]>(s.size() + 1), s.size() + 1};
      std::memcpy(r.bytes.get(), s.data(), s.size());
      r.bytes[s.size()] = std::byte{0};
      return r;
    }
    case TagKind::Root:
      return filled([&](std::size_t& size) { return root_record(*this, size); });
    case TagKind::Made:
      return filled(
          [&](std::size_t& size) { return element_record(*this, made::name_of(tag), size); });
    case TagKind::Declaration:
      if (const UserSpec* spec = declaration(tag)) return record(miFunction_decl{spec->version});
      break;
    default:
      break;
  }
  return {};
}

void Host::renew(miTag tag) {
  const std::unique_lock lock(mutex_);
  const auto found = records_.find(tag);
  if (found == records_.end()) return;
  replaced_.push_back(std::move(found->second));
  records_.erase(found);
}

miTag Host::behind_texture(miTag tag) {
  const TextureNode* const from = texture(tag);
  return from && !from->procedure().empty() ? tag_of(from->procedure().front()) : tag;
}

miImg_image* Host::image_of(miTag tag) {
  {
    const std::shared_lock lock(mutex_);
    if (const auto found = pictures_.find(tag); found != pictures_.end())
      return found->second.get();
  }
  const TextureNode* const from = texture(tag);
  if (!from || from->width() <= 0 || from->height() <= 0) return nullptr;
  const auto width = static_cast<float>(from->width()), height = static_cast<float>(from->height());
  auto picture = std::make_unique<Picture>(miIMG_TYPE_RGBA_FP, from->width(), from->height());
  for (int y = 0; y < picture->height; ++y)
    for (int x = 0; x < picture->width; ++x)
      picture->set_colour(x, y,
                          from->texel(Vec2((static_cast<float>(x) + .5f) / width,
                                           (static_cast<float>(y) + .5f) / height)));
  picture->writable = miFALSE;
  const std::unique_lock lock(mutex_);
  return pictures_.try_emplace(tag, std::move(picture)).first->second.get();
}

void* Host::access(miTag tag) {
  if (const miTag shader = behind_texture(tag); shader != tag) return access(shader);
  if (kind_of(tag) == TagKind::Texture && world_) return image_of(tag);
  if (miObject* made = GeometryWork::object_of(tag)) return made;
  if (kind_of(tag) == TagKind::Element) return elements_.bytes(tag);
  if (tag == miNULLTAG || !world_) return nullptr;
  if (const ShaderNode* n = node(tag))
    if (UserInstance* user = user_instance(*n)) {
      if (!user->ready.load(std::memory_order_acquire)) user->make_ready(*n);
      return user->function;
    }
  if (kind_of(tag) == TagKind::Profile)  // for mi_lightprofile_value
    return const_cast<photometry::LightProfile*>(profile(tag));
  {
    const std::shared_lock lock(mutex_);
    if (const auto found = records_.find(tag); found != records_.end())
      return found->second.bytes.get();
  }
  Record made = make(tag);  // may request further tags
  if (!made.bytes) return nullptr;
  const std::unique_lock lock(mutex_);
  return records_.try_emplace(tag, std::move(made)).first->second.bytes.get();
}

std::size_t Host::size_of_record(miTag tag) {
  if (kind_of(tag) == TagKind::Element) return elements_.size(tag);
  if (GeometryWork::object_of(tag)) return sizeof(miObject);
  if (!access(tag)) return 0;
  if (type_of(tag) == miSCENE_IMAGE) return sizeof(miImg_image);
  const std::shared_lock lock(mutex_);
  const auto found = records_.find(tag);
  return found == records_.end() ? sizeof(miFunction) : found->second.size;
}

miScene_types Host::type_of(miTag tag) const {
  if (const TextureNode* t = texture(tag); t && !t->procedure().empty()) return miSCENE_FUNCTION;
  switch (kind_of(tag)) {
    case TagKind::Function:
      return miSCENE_FUNCTION;
    case TagKind::Declaration:
      return miSCENE_FUNCTION_DECL;
    case TagKind::Texture:
      return miSCENE_IMAGE;
    case TagKind::Text:
      return miSCENE_STRING;
    case TagKind::LightInstance:
    case TagKind::Instance:
    case TagKind::CameraInstance:
      return miSCENE_INSTANCE;
    case TagKind::Light:
      return miSCENE_LIGHT;
    case TagKind::UserData:
      return miSCENE_USERDATA;
    case TagKind::Root:
      return miSCENE_GROUP;
    case TagKind::Material:
      return miSCENE_MATERIAL;
    case TagKind::Object:
      return miSCENE_OBJECT;
    case TagKind::Camera:
      return miSCENE_CAMERA;
    case TagKind::Options:
      return miSCENE_OPTIONS;
    case TagKind::Profile:
      return miSCENE_LIGHTPROFILE;
    case TagKind::Made:
      if (GeometryWork::object_of(tag)) return miSCENE_OBJECT;
      return type_of_element(*this, made::name_of(tag));
    case TagKind::Element:
      return static_cast<miScene_types>(elements_.type(tag));
    default:
      return miSCENE_NONE;
  }
}

const miCamera* Host::camera() {
  static const miCamera none = {};
  if (!world_) return &none;
  if (!camera_) camera_ = static_cast<const miCamera*>(access(make_tag(TagKind::Camera, 0)));
  return camera_;
}

const miOptions* Host::options() {
  static const miOptions none = {};
  if (!world_) return &none;
  if (!options_) options_ = static_cast<const miOptions*>(access(make_tag(TagKind::Options, 0)));
  return options_;
}

const std::vector<miTag>& Host::lights() {
  const std::unique_lock lock(mutex_);
  if (lights_.empty() && world_)
    for (std::size_t i = 0; i < world_->lights.size(); ++i)
      lights_.push_back(make_tag(TagKind::LightInstance, i));
  return lights_;
}

}  // namespace oriel::sdk

using namespace oriel::sdk;

extern "C" {

void* mi_db_access(miTag tag) {
  Host* host = current_host();
  return host ? host->access(tag) : nullptr;
}
void mi_db_unpin(miTag) {}  // elements exist until the end of the frame
int mi_db_type(miTag tag) {
  Host* host = current_host();
  return host ? host->type_of(tag) : miSCENE_NONE;
}
int mi_db_size(miTag tag) {
  Host* host = current_host();
  return host ? static_cast<int>(host->size_of_record(tag)) : 0;
}
void* mi_db_access_type(int* type, miTag tag) {
  *type = mi_db_type(tag);
  return mi_db_access(tag);
}
// Editing changes the view of the shader, not the scene, which is read-only during rendering.
void* mi_scene_edit(miTag tag) { return mi_db_access(tag); }
void mi_scene_edit_end(miTag) {}

}  // extern "C"
