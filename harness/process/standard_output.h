// What the program prints.
#pragma once

namespace touchstone::process {

// From now on each control character in what stdout and stderr get is printed as "\x1b", since names
// in files of strangers may have some: they set a terminal's title, or hide text. Line feeds, tabs, and
// the return of the progress bar stay.
void escape_output();

// Writes out what standard output still holds. Returns false, after a message, if something that was
// printed has not arrived, such as on a full disk.
bool finish_output();

}  // namespace touchstone::process
