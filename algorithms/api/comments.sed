# Comments of the public headers as Doxygen wants them: those behind a declaration are about it, others about what follows.
1s|^// |/// @file\n/// |
1s|^/[*] |/** @file\n * |
s|([;,{)]) +// |\1 ///< |
s|^( *)// |\1/// |
s|^( *)//$|\1///|
s|([;,]) +/[*] |\1 /**< |
s|^( *)/[*] |\1/** |
