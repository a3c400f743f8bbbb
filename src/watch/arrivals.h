// SPDX-License-Identifier: Apache-2.0
// Which files of a watched folder are complete. A file is taken when it was closed after writing or renamed in
// (events), or when two looks at the folder found it unchanged. Holds names and stamps only, whatever arrives.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "watch/folder_look.h"

namespace skysweep::watch {

class Arrivals {
 public:
  // Somebody writes the file.
  void written(const std::string& name);
  // The file was closed after writing, or renamed in, and has this stamp now.
  void closed(const std::string& name, const std::string& stamp);
  void gone(const std::string& name);
  // Everything that lies in the folder: what is not in it is gone.
  void look(const FolderLook& look);

  // What became complete (again) and what went since the last call, each name once and sorted.
  struct Changes {
    std::vector<std::string> complete, gone;
  };
  Changes take_changes();

  int unsettled() const;                            // files that are there and not complete
  bool is_arriving(const std::string& name) const;  // there, and not complete (any more)
  std::size_t known() const { return files_.size(); }
  bool knows_photographs() const;

 private:
  struct File {
    bool complete = false;
    std::string stamp;  // when it was last looked at; of a complete file: when it became so
  };
  void complete(const std::string& name, File& file, const std::string& stamp);

  std::map<std::string, File> files_;
  std::map<std::string, bool> changed_;  // name -> is it there
};

}  // namespace skysweep::watch
