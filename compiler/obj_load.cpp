// Wavefront .obj meshes. tinyobjloader reads them; what stands here checks the lines that it would misread in silence, splits
// the faces and finds the materials.
#include <algorithm>
#include <cfloat>
#include <charconv>
#include <cmath>
#include <set>
#include <unordered_map>

#include "mtl_load.hpp"
#include "scene.hpp"
#include "text_file.hpp"
#include "triangulate.hpp"

namespace minirtc {
namespace {

/// What stands after a usemtl (in the order of first use) or a mtllib, and where.
struct Name {
    std::string text;
    int line = 0;
};

class ObjReader {
public:
    ObjReader(const std::filesystem::path& path, Mesh& mesh) : path_(path.string()), mesh_(mesh) {}

    void read(std::string_view text) {
        RewrittenLines lines(text, [&](std::string_view line, std::string& out) {
            line_ = lines.number();
            rewrite(line, out);
        });
        tinyobj::callback_t callbacks;
        callbacks.vertex_cb = [](void* self, double x, double y, double z, double) {
            to(self).mesh_.positions.emplace_back(x, y, z);
        };
        callbacks.normal_cb = [](void* self, double x, double y, double z) { to(self).addNormal({x, y, z}); };
        callbacks.texcoord_cb = [](void* self, double u, double v, double) { to(self).addUv(u, v); };
        callbacks.index_cb = [](void* self, tinyobj::index_t* corners, int count) { to(self).addFace(corners, count); };
        callbacks.usemtl_cb = [](void* self, const char* name, int) { to(self).use(name); };
        tinyobj::LoadObjWithCallback(lines, callbacks, this);
        if (polygons_.empty()) throw Error({path_}, "the mesh has no faces", "an OBJ file needs lines such as 'f 1 2 3'");
        splitPolygons();
    }

    // Face::material counts in uses() while reading; kNone before the first usemtl.
    const std::vector<Name>& uses() const { return uses_; }
    const std::vector<Name>& libraries() const { return libraries_; }

private:
    static ObjReader& to(void* self) { return *static_cast<ObjReader*>(self); }

    [[noreturn]] void fail(const std::string& message, const std::string& hint) const {
        throw Error({path_, line_}, message, hint);
    }

    // The lines as tinyobjloader needs them: it knows no comment after numbers and takes 0 for what it cannot read. Blanks and
    // backslashes in the names of libraries are beyond it: those stay here.

    void rewrite(std::string_view line, std::string& out) {
        const std::string_view key = takeWord(line);
        if (key == "v" || key == "vn")
            rewriteNumbers(key, line, "xyz", out);
        else if (key == "vt")
            rewriteNumbers(key, line, "u", out);
        else if (key == "f" || key == "fo")
            rewriteFace(line, out);
        else if (key == "usemtl")
            out.append("usemtl ").append(trim(line));
        else if (key == "mtllib")
            libraries_.push_back({std::string(trim(line)), line_});
    }

    /// As many numbers as `needed` names; up to four more are let through, for weights and vertex colours.
    void rewriteNumbers(std::string_view key, std::string_view values, std::string_view needed, std::string& out) const {
        out += key;
        size_t count = 0;
        for (std::string_view word = takeValue(values); !word.empty(); word = takeValue(values)) {
            if (!appendNumber(out, word)) fail(inQuotes(word) + " is not a finite number", "repair the line");
            if (count++ == needed.size() + 4) fail("too many numbers after " + std::string(key), "a line break may be missing");
        }
        if (count < needed.size()) fail(std::string("the line ends before its ") + needed[count], "give three numbers");
    }

    void rewriteFace(std::string_view line, std::string& out) const {
        out += "f";
        size_t count = 0;
        for (std::string_view word = takeValue(line); !word.empty(); word = takeValue(line), ++count) {
            checkCorner(word);
            out.append(" ").append(word.substr(0, word.find_last_not_of('/') + 1));  // tinyobjloader reads 1/ 2 as 1/2 2
        }
        if (count < 3) fail("the face has " + std::to_string(count) + " corners", "a face needs at least 3");
    }

    /// `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    void checkCorner(std::string_view word) const {
        const std::string_view whole = word;
        const auto takePart = [&] {
            const size_t slash = word.find('/');
            const std::string_view part = word.substr(0, slash);
            word = slash == std::string_view::npos ? std::string_view{} : word.substr(slash + 1);
            return part;
        };
        const std::string_view v = takePart(), vt = takePart(), vn = takePart();
        if (!word.empty() || v.empty()) fail(inQuotes(whole) + " is no corner of a face", "write v, v/vt, v//vn or v/vt/vn");
        checkIndex(v, mesh_.positions.size(), "v");
        if (!vt.empty()) checkIndex(vt, mesh_.uvs.size(), "vt");
        if (!vn.empty()) checkIndex(vn, mesh_.normals.size(), "vn");
    }

    /// From 1 on, or from -1 back from the last; `count` lines stand above. Forward references are checked at the end.
    void checkIndex(std::string_view text, size_t count, const char* key) const {
        int index = 0;
        const std::string_view digits = skipPlus(text);
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
        if (end != digits.data() + digits.size() || error == std::errc::invalid_argument)
            fail(inQuotes(text) + " is not an index", "write whole numbers, such as f 1 2 3");
        if (error != std::errc{} || index == 0 || static_cast<int64_t>(count) + index < 0)
            fail("the " + std::string(key) + " index " + std::string(text) + " is out of range",
                 "indices count from 1, or from -1 backwards; " + std::to_string(count) + " " + key + " lines stand above");
    }

    // What tinyobjloader reads, a line at a time.

    /// Unit length, whatever the file's; zero stays zero.
    void addNormal(const glm::dvec3& n) {
        const double largest = std::max({std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)});
        mesh_.normals.push_back(largest == 0 ? glm::vec3(0) : glm::vec3(glm::normalize(n / largest)));
    }

    /// Row 0 of an image is at v = 1.
    void addUv(double u, double v) {
        if (std::fabs(u) > FLT_MAX || std::fabs(v) > FLT_MAX) fail("a texture coordinate is too large", "repair the line");
        mesh_.uvs.push_back(glm::vec2(u, 1 - v));
    }

    void use(std::string name) {
        const auto [found, isNew] = useIndex_.try_emplace(name, static_cast<uint32_t>(uses_.size()));
        if (isNew) uses_.push_back({std::move(name), line_});
        material_ = found->second;
    }

    void addFace(const tinyobj::index_t* corners, int count) {
        polygons_.push_back({corners_.size(), count, material_, line_});
        for (int i = 0; i < count; ++i)
            corners_.push_back({fromFile(corners[i].vertex_index, mesh_.positions.size()),
                                fromFile(corners[i].normal_index, mesh_.normals.size()),
                                fromFile(corners[i].texcoord_index, mesh_.uvs.size())});
    }

    /// From 0 on; 0 in the file, which tinyobjloader gives for what is not there, becomes kNone.
    static uint32_t fromFile(int index, size_t count) { return static_cast<uint32_t>(index < 0 ? count + index : index - 1); }

    void checkExists(uint32_t index, size_t count, const char* key) const {
        if (index == kNone || index < count) return;
        fail("the " + std::string(key) + " index " + std::to_string(index + 1) + " is out of range",
             "the file has " + std::to_string(count) + " " + key + " lines");
    }

    void splitPolygons() {
        mesh_.faces.reserve(corners_.size() - 2 * polygons_.size());
        std::vector<glm::dvec3> points;
        std::vector<TriangleIndices> triangles;
        for (const Polygon& polygon : polygons_) {
            const Corner* corners = &corners_[polygon.first];
            points.clear();
            triangles.clear();
            line_ = polygon.line;
            for (const Corner* c = corners; c != corners + polygon.size; ++c) {
                checkExists(c->position, mesh_.positions.size(), "v");
                checkExists(c->uv, mesh_.uvs.size(), "vt");
                checkExists(c->normal, mesh_.normals.size(), "vn");
                points.push_back(mesh_.positions[c->position]);
            }
            if (!triangulate(points, triangles))
                fail("the face is concave and has " + std::to_string(points.size()) + " corners", "split it into smaller faces");
            for (const TriangleIndices& t : triangles)
                mesh_.faces.push_back({{corners[t[0]], corners[t[1]], corners[t[2]]}, polygon.material, polygon.line});
        }
    }

    /// A face as written.
    struct Polygon {
        size_t first;  // in corners_
        int size;
        uint32_t material;
        int line;
    };

    std::string path_;
    Mesh& mesh_;
    int line_ = 0;
    uint32_t material_ = kNone;
    std::vector<Name> uses_;
    std::unordered_map<std::string, uint32_t> useIndex_;
    std::vector<Name> libraries_;
    std::vector<Corner> corners_;
    std::vector<Polygon> polygons_;
};

/// The files of a mtllib line: the whole rest as one name where such a file is, else its words, \ before a blank joining them.
std::vector<std::string> splitNames(const std::filesystem::path& folder, const std::string& names) {
    if (findBeside(folder, names)) return {names};
    std::vector<std::string> words(1);
    for (size_t i = 0; i < names.size(); ++i) {
        const bool joined = names[i] == '\\' && i + 1 < names.size() && names[i + 1] == ' ';
        if (joined)
            words.back() += names[++i];
        else if (names[i] != ' ' && names[i] != '\t')
            words.back() += names[i];
        else if (!words.back().empty())
            words.emplace_back();
    }
    if (words.back().empty()) words.pop_back();
    return words;
}

using MtlByName = std::unordered_map<std::string, MtlMaterial>;

MtlByName readLibraries(const std::filesystem::path& path, const std::vector<Name>& libraries, Diagnostics& diagnostics) {
    MtlByName materials;
    for (const Name& library : libraries) {
        std::string missing;
        bool found = false;
        for (const std::string& name : splitNames(path.parent_path(), library.text)) {
            const auto file = findBeside(path.parent_path(), name);
            found = found || file;
            if (!file) missing += (missing.empty() ? " " : ", ") + inQuotes(name);
            if (file)
                for (MtlMaterial& material : readMtl(*file)) materials.try_emplace(material.name, std::move(material));
        }
        // Several names are alternatives in the wild: where one is there, the others are not missed.
        if (!found)
            diagnostics.warn({path.string(), library.line}, "there is no material library" + missing,
                             "its materials become mid-grey");
    }
    return materials;
}

class MaterialBinder {
public:
    MaterialBinder(const std::filesystem::path& path, const ObjReader& reader, Mesh& mesh, Scene& scene, Diagnostics& diagnostics)
        : path_(path),
          reader_(reader),
          mesh_(mesh),
          scene_(scene),
          diagnostics_(diagnostics),
          library_(readLibraries(path, reader.libraries(), diagnostics)) {}

    /// Turns the faces' usemtl numbers into indices of mesh.materials.
    void bind() {
        std::vector<uint32_t> local(reader_.uses().size(), kNone);
        for (Face& face : mesh_.faces) {
            if (face.material == kNone) {
                face.material = grey("faces have no usemtl above them", face.line);
                continue;
            }
            uint32_t& index = local[face.material];
            if (index == kNone) index = find(reader_.uses()[face.material]);
            face.material = index;
        }
    }

private:
    uint32_t find(const Name& use) {
        const auto found = library_.find(use.text);
        if (found != library_.end()) return add(toMaterial(found->second, scene_, diagnostics_));
        std::vector<std::string> known;
        for (const auto& entry : library_) known.push_back(entry.first);
        std::sort(known.begin(), known.end());
        const std::string nearest = nearestWord(use.text, known);
        const std::string near = nearest.empty() ? "" : " (near: " + inQuotes(nearest) + ")";
        return grey("no library has the material " + inQuotes(use.text) + near, use.line);
    }

    uint32_t add(const Material& material) {
        scene_.materials.push_back(material);
        mesh_.materials.push_back(static_cast<uint32_t>(scene_.materials.size() - 1));
        return static_cast<uint32_t>(mesh_.materials.size() - 1);
    }

    /// Stands in for a material that is not there: a Lambert surface of half reflectance.
    uint32_t grey(const std::string& reason, int line) {
        if (warned_.insert(reason).second)
            diagnostics_.warn({path_.string(), line}, reason, "mid-grey is used; a 'material' in the scene file overrides it");
        if (grey_ == kNone) {
            Material lambert;
            lambert.name = "mid-grey";
            lambert.diffuse = glm::vec3(0.5f);
            grey_ = add(lambert);
        }
        return grey_;
    }

    const std::filesystem::path& path_;
    const ObjReader& reader_;
    Mesh& mesh_;
    Scene& scene_;
    Diagnostics& diagnostics_;
    MtlByName library_;
    std::set<std::string> warned_;
    uint32_t grey_ = kNone;
};

}  // namespace

Mesh loadObj(const std::filesystem::path& path, bool wantMaterials, Scene& scene, Diagnostics& diagnostics) {
    Mesh mesh;
    mesh.path = path.string();
    ObjReader reader(path, mesh);
    reader.read(readTextFile(path));
    if (wantMaterials) {
        MaterialBinder(path, reader, mesh, scene, diagnostics).bind();
    } else {
        for (Face& face : mesh.faces) face.material = kNone;
    }
    return mesh;
}

}  // namespace minirtc
