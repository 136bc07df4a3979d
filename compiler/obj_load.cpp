// Wavefront .obj meshes. The reader is the project's own: it names the line of what it cannot read and keeps each face's line,
// faces have any number of corners, and numbers are rounded correctly.
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

/// A usemtl name, in the order of first use, and where that is.
struct MaterialUse {
    std::string name;
    int line = 0;
};

struct MaterialLibrary {
    std::string names;  // the rest of a mtllib line
    int line = 0;
};

class ObjReader {
public:
    ObjReader(const std::filesystem::path& path, Mesh& mesh) : path_(path.string()), mesh_(mesh) {}

    void read(std::string_view text) {
        for (LineReader lines(text); lines.next();) {
            line_ = lines.number();
            readLine(lines.line());
        }
        if (polygons_.empty()) throw Error({path_}, "the mesh has no faces", "an OBJ file needs lines such as 'f 1 2 3'");
        checkIndices();
        splitPolygons();
    }

    // Face::material counts in uses() while reading; kNone before the first usemtl.
    const std::vector<MaterialUse>& uses() const { return uses_; }
    const std::vector<MaterialLibrary>& libraries() const { return libraries_; }

private:
    void readLine(std::string_view line) {
        const std::string_view key = takeWord(line);
        if (key == "v") {
            mesh_.positions.push_back(takeVector(line));
            rejectRest(line, "v");
        } else if (key == "vn") {
            mesh_.normals.push_back(direction(takeVector(line)));
            rejectRest(line, "vn");
        } else if (key == "vt") {
            readUv(line);
        } else if (key == "f" || key == "fo") {
            readFace(line);
        } else if (key == "usemtl") {
            readUse(std::string(trim(line)));
        } else if (key == "mtllib") {
            libraries_.push_back({std::string(trim(line)), line_});
        }
    }

    [[noreturn]] void fail(const std::string& message, const std::string& hint) const {
        throw Error({path_, line_}, message, hint);
    }

    double toNumber(std::string_view word) const {
        const std::optional<double> number = parseFinite(word);
        if (!number) fail(inQuotes(word) + " is not a finite number", "repair the line");
        return *number;
    }

    double take(std::string_view& line, const char* what) const {
        const std::string_view word = takeValue(line);
        if (word.empty()) fail(std::string("the line ends before its ") + what, "give three numbers");
        return toNumber(word);
    }

    glm::dvec3 takeVector(std::string_view& line) const {
        return {take(line, "x"), take(line, "y"), take(line, "z")};  // braces: evaluated in this order
    }

    /// Unit length, whatever the file's; zero stays zero.
    static glm::vec3 direction(const glm::dvec3& n) {
        const double largest = std::max({std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)});
        return largest == 0 ? glm::vec3(0) : glm::vec3(glm::normalize(n / largest));
    }

    /// Weights and vertex colours, which are not used, must be numbers all the same.
    void rejectRest(std::string_view line, const char* key) const {
        constexpr int kMost = 5;  // x y z w, x y z r g b and x y z r g b a are in use
        int count = 0;
        for (std::string_view word = takeValue(line); !word.empty(); word = takeValue(line)) {
            toNumber(word);
            if (++count == kMost) fail(std::string("too many numbers after ") + key, "a line break may be missing");
        }
    }

    /// Row 0 of an image is at v = 1.
    void readUv(std::string_view line) {
        const double u = take(line, "u");
        const std::string_view word = takeValue(line);
        const double v = word.empty() ? 0 : toNumber(word);
        rejectRest(line, "vt");
        if (std::fabs(u) > FLT_MAX || std::fabs(v) > FLT_MAX) fail("a texture coordinate is too large", "repair the line");
        mesh_.uvs.push_back(glm::vec2(u, 1 - v));
    }

    void readUse(std::string name) {
        const auto [found, isNew] = useIndex_.try_emplace(name, static_cast<uint32_t>(uses_.size()));
        if (isNew) uses_.push_back({std::move(name), line_});
        material_ = found->second;
    }

    void readFace(std::string_view line) {
        polygons_.push_back({corners_.size(), material_, line_});
        for (std::string_view word = takeValue(line); !word.empty(); word = takeValue(line)) corners_.push_back(readCorner(word));
        const size_t size = corners_.size() - polygons_.back().first;
        if (size < 3) fail("the face has " + std::to_string(size) + " corners", "a face needs at least 3");
    }

    /// `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    Corner readCorner(std::string_view word) const {
        const std::string_view whole = word;
        const auto takePart = [&] {
            const size_t slash = word.find('/');
            const std::string_view part = word.substr(0, slash);
            word = slash == std::string_view::npos ? std::string_view{} : word.substr(slash + 1);
            return part;
        };
        const std::string_view v = takePart(), vt = takePart(), vn = takePart();
        if (!word.empty() || v.empty()) fail(inQuotes(whole) + " is no corner of a face", "write v, v/vt, v//vn or v/vt/vn");
        Corner corner;
        corner.position = readIndex(v, mesh_.positions.size(), "v");
        if (!vt.empty()) corner.uv = readIndex(vt, mesh_.uvs.size(), "vt");
        if (!vn.empty()) corner.normal = readIndex(vn, mesh_.normals.size(), "vn");
        return corner;
    }

    /// From 1 on, or from -1 back from the last; `count` lines stand above. Forward references are checked at the end.
    uint32_t readIndex(std::string_view text, size_t count, const char* key) const {
        int64_t index = 0;
        const std::string_view digits = text.substr(text.front() == '+' ? 1 : 0);
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
        if (end != digits.data() + digits.size() || error == std::errc::invalid_argument)
            fail(inQuotes(text) + " is not an index", "write whole numbers, such as f 1 2 3");
        const int64_t absolute = index < 0 ? static_cast<int64_t>(count) + index : index - 1;
        if (error != std::errc{} || index == 0 || absolute < 0 || absolute >= int64_t{kNone})
            fail("the " + std::string(key) + " index " + std::string(text) + " is out of range",
                 "indices count from 1, or from -1 backwards; " + std::to_string(count) + " " + key + " lines stand above");
        return static_cast<uint32_t>(absolute);
    }

    size_t endOf(size_t polygon) const { return polygon + 1 < polygons_.size() ? polygons_[polygon + 1].first : corners_.size(); }

    void checkIndices() {
        const auto check = [&](uint32_t index, size_t count, const char* key) {
            if (index == kNone || index < count) return;
            fail("the " + std::string(key) + " index " + std::to_string(index + 1) + " is out of range",
                 "the file has " + std::to_string(count) + " " + key + " lines");
        };
        for (size_t i = 0; i < polygons_.size(); ++i) {
            line_ = polygons_[i].line;
            for (size_t c = polygons_[i].first; c < endOf(i); ++c) {
                check(corners_[c].position, mesh_.positions.size(), "v");
                check(corners_[c].uv, mesh_.uvs.size(), "vt");
                check(corners_[c].normal, mesh_.normals.size(), "vn");
            }
        }
    }

    void splitPolygons() {
        mesh_.faces.reserve(corners_.size() - 2 * polygons_.size());
        std::vector<glm::dvec3> points;
        std::vector<TriangleIndices> triangles;
        for (size_t i = 0; i < polygons_.size(); ++i) {
            const Polygon& polygon = polygons_[i];
            const Corner* corners = &corners_[polygon.first];
            points.clear();
            triangles.clear();
            for (size_t c = polygon.first; c < endOf(i); ++c) points.push_back(mesh_.positions[corners_[c].position]);
            line_ = polygon.line;
            if (!triangulate(points, triangles))
                fail("the face is concave and has " + std::to_string(points.size()) + " corners", "split it into smaller faces");
            for (const TriangleIndices& t : triangles)
                mesh_.faces.push_back({{corners[t[0]], corners[t[1]], corners[t[2]]}, polygon.material, polygon.line});
        }
    }

    /// A face as written; its corners reach to the next one's first.
    struct Polygon {
        size_t first;  // in corners_
        uint32_t material;
        int line;
    };

    std::string path_;
    Mesh& mesh_;
    int line_ = 0;
    uint32_t material_ = kNone;
    std::vector<MaterialUse> uses_;
    std::unordered_map<std::string, uint32_t> useIndex_;
    std::vector<MaterialLibrary> libraries_;
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

MtlByName readLibraries(const std::filesystem::path& path, const std::vector<MaterialLibrary>& libraries,
                        Diagnostics& diagnostics) {
    MtlByName materials;
    for (const MaterialLibrary& library : libraries) {
        std::string missing;
        bool found = false;
        for (const std::string& name : splitNames(path.parent_path(), library.names)) {
            const auto file = findBeside(path.parent_path(), name);
            found = found || file;
            if (!file) missing += (missing.empty() ? " " : ", ") + inQuotes(name);
            if (file)
                for (MtlMaterial& material : readMtl(*file, diagnostics))
                    materials.try_emplace(material.name, std::move(material));
        }
        // Several names are alternatives in the wild: where one is there, the others are not missed.
        if (!found)
            diagnostics.warn({path.string(), library.line}, "there is no material library" + missing,
                             "its materials become mid-grey");
    }
    return materials;
}

/// Stands in for a material that is not there: a Lambert surface of half reflectance.
uint32_t addMidGrey(Scene& scene) {
    Material grey;
    grey.name = "mid-grey";
    grey.diffuse = glm::vec3(0.5f);
    scene.materials.push_back(grey);
    return static_cast<uint32_t>(scene.materials.size() - 1);
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
    uint32_t find(const MaterialUse& use) {
        const auto found = library_.find(use.name);
        if (found == library_.end()) {
            std::vector<std::string> known;
            for (const auto& entry : library_) known.push_back(entry.first);
            std::sort(known.begin(), known.end());
            const std::string nearest = nearestWord(use.name, known);
            return grey("no library has the material " + inQuotes(use.name) +
                            (nearest.empty() ? "" : " (near: " + inQuotes(nearest) + ")"),
                        use.line);
        }
        Material material = toMaterial(found->second, scene_, diagnostics_);
        scene_.materials.push_back(std::move(material));
        mesh_.materials.push_back(static_cast<uint32_t>(scene_.materials.size() - 1));
        return static_cast<uint32_t>(mesh_.materials.size() - 1);
    }

    uint32_t grey(const std::string& reason, int line) {
        if (warned_.insert(reason).second)
            diagnostics_.warn({path_.string(), line}, reason, "mid-grey is used; a 'material' in the scene file overrides it");
        if (grey_ == kNone) {
            mesh_.materials.push_back(addMidGrey(scene_));
            grey_ = static_cast<uint32_t>(mesh_.materials.size() - 1);
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
