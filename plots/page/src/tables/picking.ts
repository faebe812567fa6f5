// A reader picks rows by mouse or by keyboard, as in a grid of WAI-ARIA: the Tab key stops once in the table, arrow
// keys go from row to row, Enter and the space bar pick.

const steps: Record<string, (row: number, rows: number) => number> = {
  ArrowDown: (row) => row + 1,
  ArrowUp: (row) => row - 1,
  Home: () => 0,
  End: (_, rows) => rows - 1,
};

const row_of = (target: EventTarget | null): HTMLTableRowElement | null =>
  target instanceof Element ? target.closest<HTMLTableRowElement>("tr.pickable") : null;

// The Tab key stops at this row from now on.
function stop_at(body: HTMLTableSectionElement, row: HTMLTableRowElement): void {
  for (const each of body.rows) each.tabIndex = each === row ? 0 : -1;
}

// `pick` gets the row's element. Rows that are added later are asked to `join`.
export function pickable_rows(
  table: HTMLTableElement,
  body: HTMLTableSectionElement,
  pick: (row: HTMLTableRowElement) => void,
): { join: (row: HTMLTableRowElement) => void } {
  table.setAttribute("role", "grid");
  const picked = (row: HTMLTableRowElement): void => {
    for (const each of body.rows) each.ariaSelected = String(each === row);
    stop_at(body, row);
    pick(row);
  };
  body.addEventListener("click", (event) => {
    const row = row_of(event.target);
    if (row && !(event.target instanceof HTMLAnchorElement)) picked(row);
  });
  body.addEventListener("keydown", (event) => {
    const row = row_of(event.target);
    if (!row || event.target !== row) return;
    const rows = [...body.rows];
    const next = rows[steps[event.key]?.(rows.indexOf(row), rows.length) ?? -1];
    if (next) {
      stop_at(body, next);
      next.focus();
    } else if (event.key === "Enter" || event.key === " ") {
      picked(row);
    } else {
      return;
    }
    event.preventDefault();
  });
  return {
    join: (row) => {
      row.classList.add("pickable");
      row.ariaSelected = "false";
      row.tabIndex = row.sectionRowIndex === 0 ? 0 : -1;
    },
  };
}
