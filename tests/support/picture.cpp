// SPDX-License-Identifier: Apache-2.0
#include "support/picture.h"

#include <stdexcept>

#include "output/output_names.h"

namespace oriel::testing {

Rgb mean_of(const Film& film) {
  Imath::Vec3<double> sum(0.0);  // double: a mean of thousands
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) sum += Imath::Vec3<double>(rgb(film.pixel(x, y).beauty));
  return Rgb(Imath::V3f(sum / (double(film.width()) * film.height())));
}

Rgb RenderedScene::mean() const { return mean_of(session_.film()); }

Picture::Picture(const std::string& scene, std::uint32_t samples, bool outputs) {
  const RenderedScene rendered(scene, {.budget = {.samples = samples}, .outputs = outputs});
  layers_ = film_layers(rendered.session(), LayerSet(LayerGroup::Outputs));
}

const Image& Picture::layer(const std::string& name) const {
  const Layer* found = find_layer(layers_, name);
  if (!found) throw std::runtime_error("no layer " + name);
  return found->image;
}

Rgb Picture::at(const std::string& name, int x, int y) const {
  const Image& image = layer(name);
  const float* p = image.at(x, y);
  return image.channels == 1 ? Rgb(*p) : Rgb(p[0], p[1], p[2]);
}

Rgb Picture::mean(const std::string& name) const {
  const Image& image = layer(name);
  Imath::Vec3<double> sum(0.0);  // double: a mean of thousands
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) sum += Imath::Vec3<double>(at(name, x, y));
  return Rgb(Imath::V3f(sum / double(image.pixel_count())));
}

void expect_only(const Picture& p, const std::set<std::string>& wanted, const std::string& what) {
  for (const std::string name : kResults) {
    if (wanted.count(name))
      EXPECT_GT(p.mean(name).x, 1e-3f) << what << ": " << name;
    else
      EXPECT_EQ(p.mean(name), Rgb(0)) << what << ": " << name;
  }
}

}  // namespace oriel::testing
