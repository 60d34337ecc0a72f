// frames.hpp: deformed shapes and contact forces at chosen times (docs/output.md).
//
//   frames.csv          t,kind,element,node,x,y,ux,uy,rz
//   frame_contacts.csv  t,contact,state,node,x,y,ux,uy,nx,ny,tx,ty,N,T
//
// kind: beam, bar or spring (two rows per element, one for each end; "B-D.3" is an inner node), then node or support
// (one row per named node, element empty). x, y: undeformed. The force on the body at a contact is -N n - T t. Both
// files are created with the first frame. Errors: FileError.
#pragma once

#include <filesystem>

#include "result/run_tables.hpp"

namespace signorini {

class FrameWriter {
 public:
  FrameWriter(const std::filesystem::path& directory, const Model& model);
  void write(const Sample& sample);

 private:
  void write_shape(const Sample& sample);
  void write_contacts(const Sample& sample);

  const Model& model_;
  TableFile<FrameRow> shapes_;
  TableFile<FrameContactRow> contacts_;
};

}  // namespace signorini
