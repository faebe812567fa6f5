// Reads CSV text on its own, so that the page's reader is compared with another one.

export function csv_rows(text) {
  const rows = [];
  let row = [],
    field = "",
    quoted = false;
  for (let i = 0; i < text.length; ++i) {
    const letter = text[i];
    if (quoted) {
      if (letter !== '"') field += letter;
      else if (text[i + 1] === '"') field += text[++i];
      else quoted = false;
    } else if (letter === '"') {
      quoted = true;
    } else if (letter === ",") {
      row.push(field);
      field = "";
    } else if (letter === "\n") {
      row.push(field.replace(/\r$/, ""));
      if (row.length > 1 || row[0] !== "") rows.push(row);
      row = [];
      field = "";
    } else {
      field += letter;
    }
  }
  const [columns = [], ...lines] = rows;
  return { columns, lines };
}
