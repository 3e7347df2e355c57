// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's shape-diameter segmentation with its defaults, for benchmarks/cgal.py.
//
// Reads meshes one after another from standard input: a line with the numbers of vertices and of triangles, then the
// positions, then the corners. Answers each by a line with the processor seconds of the shape diameters and of the
// segmentation, and a line with the segment of each triangle; or by the line "refused" if CGAL takes it for no surface.
// One process does all meshes, so that it keeps the memory that the first have left, as ours does.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/mesh_segmentation.h>

#include <ctime>
#include <iostream>
#include <vector>

// The kernel that CGAL's own examples use, with exact predicates, takes a fifth longer for the same.
typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

static double seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

// Whether all triangles were added: a surface mesh refuses those at which it would branch.
static bool read_mesh(Mesh& mesh, std::size_t n_vertices, std::size_t n_faces)
{
  std::vector<Mesh::Vertex_index> vertex(n_vertices);
  for (Mesh::Vertex_index& v : vertex) {
    double x, y, z;
    std::cin >> x >> y >> z;
    v = mesh.add_vertex(Kernel::Point_3(x, y, z));
  }
  bool whole = true;
  for (std::size_t f = 0; f < n_faces; ++f) {
    std::size_t a, b, c;
    std::cin >> a >> b >> c;
    whole = mesh.add_face(vertex[a], vertex[b], vertex[c]) != Mesh::null_face() && whole;
  }
  return whole;
}

int main()
{
  std::ios::sync_with_stdio(false);
  std::size_t n_vertices, n_faces;
  while (std::cin >> n_vertices >> n_faces) {
    Mesh mesh;
    if (!read_mesh(mesh, n_vertices, n_faces)) {
      std::cout << "refused" << std::endl;
      continue;
    }
    auto diameter = mesh.add_property_map<Mesh::Face_index, double>("f:diameter").first;
    auto segment = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;
    const double start = seconds();
    CGAL::sdf_values(mesh, diameter);
    const double middle = seconds();
    CGAL::segmentation_from_sdf_values(mesh, diameter, segment);
    std::cout << middle - start << ' ' << seconds() - middle << '\n';
    for (Mesh::Face_index f : mesh.faces()) std::cout << segment[f] << ' ';
    std::cout << std::endl;
  }
}
