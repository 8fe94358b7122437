// SPDX-License-Identifier: Apache-2.0
// What models of strangers may read: buffers, material libraries and pictures.
#include <fmt/format.h>

#include "confinement.h"

namespace oriel {
namespace model_confinement_test {

namespace fs = std::filesystem;

const std::string kUp = "../../../../../../../..";

std::string gltf(const std::string& buffer, const std::string& image) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],)"
         R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
         R"("textures":[{"source":0}],"images":[{"uri":")" +
         image +
         R"("}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)"
         R"("min":[0,0,0],"max":[1,1,0]},{"bufferView":1,"componentType":5126,"count":3,)"
         R"("type":"VEC2"}],"bufferViews":[{"buffer":0,"byteLength":36},)"
         R"({"buffer":0,"byteOffset":36,"byteLength":24}],"buffers":[{"byteLength":60,"uri":")" +
         buffer + R"("}]})";
}

std::string gltf1(const std::string& buffer) {
  return R"({"asset":{"version":"1.0"},"scene":"s","scenes":{"s":{"nodes":["n"]}},)"
         R"("nodes":{"n":{"meshes":["m"]}},"meshes":{"m":{"primitives":[{"attributes":)"
         R"({"POSITION":"p"},"mode":4}]}},"accessors":{"p":{"bufferView":"v","byteOffset":0,)"
         R"("componentType":5126,"count":3,"type":"VEC3"}},"bufferViews":{"v":{"buffer":"b",)"
         R"("byteOffset":0,"byteLength":36,"target":34962}},"buffers":{"b":{"byteLength":36,)"
         R"("type":"arraybuffer","uri":")" +
         buffer + R"("}}})";
}

std::string obj(const std::string& library) {
  return "mtllib " + library +
         "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl red\nf 1/1 2/2 3/3\n";
}

std::string collada(const std::string& picture) {
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" )"
         R"(version="1.4.1"><asset><unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>)"
         R"(<library_images><image id="i" name="i"><init_from>)" +
         picture +
         R"(</init_from></image></library_images><library_effects><effect id="e"><profile_COMMON>)"
         R"(<newparam sid="su"><surface type="2D"><init_from>i</init_from></surface></newparam>)"
         R"(<newparam sid="sa"><sampler2D><source>su</source></sampler2D></newparam>)"
         R"(<technique sid="c"><lambert><diffuse><texture texture="sa" texcoord="UV"/></diffuse>)"
         R"(</lambert></technique></profile_COMMON></effect></library_effects><library_materials>)"
         R"(<material id="m" name="m"><instance_effect url="#e"/></material></library_materials>)"
         R"(<library_geometries><geometry id="g" name="g"><mesh><source id="p">)"
         R"(<float_array id="pa" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>)"
         R"(<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/>)"
         R"(<param name="Y" type="float"/><param name="Z" type="float"/></accessor>)"
         R"(</technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/>)"
         R"(</vertices><triangles count="1" material="m"><input semantic="VERTEX" source="#v" )"
         R"(offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>)"
         R"(<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g">)"
         R"(<bind_material><technique_common><instance_material symbol="m" target="#m"/>)"
         R"(</technique_common></bind_material></instance_geometry></node></visual_scene>)"
         R"(</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

/// FBX 7.4 in text: a triangle whose material has a picture.
std::string fbx(const std::string& picture) {
  return "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n"
         "\tFBXVersion: 7400\n}\nGlobalSettings:  {\n\tVersion: 1000\n}\nObjects:  {\n"
         "\tGeometry: 1, \"Geometry::g\", \"Mesh\" {\n\t\tVertices: *9 {\n\t\t\ta: "
         "0,0,0,1,0,0,0,1,0\n\t\t}\n\t\tPolygonVertexIndex: *3 {\n\t\t\ta: 0,1,-3\n\t\t}\n"
         "\t\tLayerElementMaterial: 0 {\n\t\t\tMappingInformationType: \"AllSame\"\n"
         "\t\t\tReferenceInformationType: \"IndexToDirect\"\n\t\t\tMaterials: *1 {\n"
         "\t\t\t\ta: 0\n\t\t\t}\n\t\t}\n"
         "\t\tLayerElementUV: 0 {\n\t\t\tMappingInformationType: \"ByPolygonVertex\"\n"
         "\t\t\tReferenceInformationType: \"Direct\"\n\t\t\tUV: *6 {\n\t\t\t\ta: "
         "0,0,1,0,0,1\n\t\t\t}\n\t\t}\n\t\tLayer: 0 {\n\t\t\tLayerElement:  {\n"
         "\t\t\t\tType: \"LayerElementUV\"\n\t\t\t\tTypedIndex: 0\n\t\t\t}\n"
         "\t\t\tLayerElement:  {\n\t\t\t\tType: \"LayerElementMaterial\"\n"
         "\t\t\t\tTypedIndex: 0\n\t\t\t}\n\t\t}\n\t}\n"
         "\tModel: 2, \"Model::n\", \"Mesh\" {\n\t\tVersion: 232\n\t}\n"
         "\tMaterial: 3, \"Material::m\", \"\" {\n\t\tVersion: 102\n\t}\n"
         "\tTexture: 4, \"Texture::t\", \"\" {\n\t\tType: \"TextureVideoClip\"\n\t\tFileName: \"" +
         picture + "\"\n\t\tRelativeFilename: \"" + picture +
         "\"\n\t}\n}\nConnections:  {\n\tC: \"OO\",2,0\n\tC: \"OO\",1,2\n\tC: \"OO\",3,2\n"
         "\tC: \"OP\",4,3, \"DiffuseColor\"\n}\n";
}

class ModelConfinement : public ConfinementTest {
 protected:
  /// The messages of a conversion to scene/made.mi.
  RunResult convert(const std::string& name, const std::string& content,
                    const std::string& options) const {
    write("scene/" + name, content);
    fs::remove(file("scene/made.mi"));
    const RunResult r = limited("convert scene/" + name + " scene/made.mi " + options);
    EXPECT_NE(r.exit_code, 124) << name << " hangs";
    EXPECT_TRUE(r.exit_code == 0 || r.exit_code == 1) << name << r.exit_code << r.err;
    return r;
  }
  bool made(const std::string& words) const {
    return there("scene/made.mi") &&
           text_of(file("scene/made.mi")).find(words) != std::string::npos;
  }
};

// acceptance: Z5
TEST_F(ModelConfinement, BuffersOfGltf) {
  for (const char* version : {"2.0", "1.0"}) {
    const auto read = [&](const std::string& uri, const std::string& options) {
      const std::string text = version[0] == '2' ? gltf(uri, "a.png") : gltf1(uri);
      convert("m.gltf", text, options);
      return made("object ");
    };
    EXPECT_TRUE(read("a.bin", "--untrusted")) << version;
    EXPECT_TRUE(read("own.bin", "--untrusted")) << version;
    for (const std::string& name : {std::string("../other/a.bin"), std::string("link.bin")}) {
      EXPECT_TRUE(read(name, "")) << version << name;
      EXPECT_FALSE(read(name, "--untrusted")) << version << name;
      EXPECT_TRUE(read(name, "--untrusted --allow other")) << version << name;
    }
    for (const char* mode : {"", "--untrusted --allow /"})
      for (const std::string& name :
           {std::string("pipe.bin"), kUp + "/dev/zero", kUp + "/proc/self/environ",
            std::string("http://127.0.0.1:9/a.bin"), std::string("file:///etc/passwd")})
        EXPECT_FALSE(read(name, mode)) << version << name << mode;
  }
}

// acceptance: Z5
TEST_F(ModelConfinement, MaterialLibrariesOfObj) {
  const auto refused = [&](const std::string& name, const std::string& options) {
    const RunResult r = convert("m.obj", obj(name), options);
    EXPECT_TRUE(made("object ")) << r.err;
    return says(r, "OR-MD-025");
  };
  for (const char* mode : {"", "--untrusted"}) {
    EXPECT_FALSE(refused("a.mtl", mode));
    EXPECT_FALSE(refused("own.mtl", mode));
    for (const char* name : {"link.mtl", "../other/a.mtl", "pipe.mtl"})
      EXPECT_TRUE(refused(name, mode)) << name;
  }
  EXPECT_FALSE(refused("link.mtl", "--allow other"));
  for (const std::string& name : {kUp + "/dev/zero", kUp + "/proc/self/environ"})
    EXPECT_TRUE(refused(name, "--allow /")) << name;
}

// acceptance: Z5
TEST_F(ModelConfinement, PicturesOfModels) {
  fs::rename(file("scene/a.png"), file("scene/in.png"));
  for (const std::string model : {"m.gltf", "m.obj", "m.dae", "m.fbx"}) {
    const auto names_picture = [&](const std::string& picture, const std::string& options) {
      write("scene/t.mtl", "newmtl red\nmap_Kd " + picture + "\n");
      const RunResult r = convert(model,
                                  model == "m.gltf"  ? gltf("a.bin", picture)
                                  : model == "m.obj" ? obj("t.mtl")
                                  : model == "m.dae" ? collada(picture)
                                                     : fbx(picture),
                                  options);
      EXPECT_TRUE(made("object ")) << model << r.err;
      return made("color texture");
    };
    EXPECT_TRUE(names_picture("in.png", "--untrusted")) << model;
    EXPECT_TRUE(names_picture("../other/a.png", "")) << model;
    for (const char* name : {"../other/a.png", "link.png"}) {
      EXPECT_FALSE(names_picture(name, "--untrusted")) << model << name;
      EXPECT_TRUE(names_picture(name, "--untrusted --allow other")) << model << name;
    }
    // Importers remove file:// from absolute paths.
    EXPECT_FALSE(names_picture("file:///etc/hostname", "--untrusted")) << model;
    for (const char* name : {"pipe.png", "http://127.0.0.1:9/b.png"})
      for (const char* mode : {"", "--untrusted --allow /"})
        EXPECT_FALSE(names_picture(name, mode)) << model << name << mode;
  }
}

// acceptance: Z5
TEST_F(ModelConfinement, ModelsThatArePipesAreRefused) {
  for (const char* suffix : {"gltf", "glb", "obj", "fbx", "dae", "ifc", "stl", "ply", "3ds"}) {
    const std::string name = std::string("scene/m.") + suffix;
    mkfifo(file(name).c_str(), 0600);
    const RunResult r = limited("convert " + name + " made.mi");
    EXPECT_TRUE(r.exit_code == 1 || r.exit_code == 2) << name << r.exit_code << r.err;
  }
}

}  // namespace model_confinement_test
}  // namespace oriel
