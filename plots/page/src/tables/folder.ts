// A folder holds the results of one run. Its files are parsed when somebody first asks for them, since most are
// never looked at.
import { fresh_anchor } from "../base/anchors";
import type { CaseView, Results } from "../bundle";
import { file_grid, type GridOptions } from "./grid";
import { pairs_of, type Pair } from "./pairs";
import { Row, Table } from "./table";

export class Folder {
  readonly anchor: string;
  readonly files: string[];
  private readonly texts: Map<string, string>;
  private readonly parsed = new Map<string, Table>();
  private readonly shown = new Set<string>();

  readonly name: string; // the program makes it different from all others of the page

  readonly pairs: Pair[];
  readonly recorded: CaseView[]; // pairs with the answers of versions

  constructor(readonly results: Results) {
    this.pairs = pairs_of(results.cases.filter(({ recorded }) => !recorded));
    this.recorded = results.cases.filter(({ recorded }) => recorded);
    this.name = results.name;
    this.anchor = fresh_anchor(this.name);
    this.texts = new Map(Object.entries(results.files));
    this.files = [...this.texts.keys()];
  }

  has(file: string): boolean {
    return this.rows(file).length > 0;
  }

  table(file: string): Table {
    let table = this.parsed.get(file);
    if (!table) {
      table = new Table(this.texts.get(file) ?? "");
      this.parsed.set(file, table);
    }
    return table;
  }

  rows(file: string): Row[] {
    return this.table(file).rows;
  }

  // This is the file's table on the page; each file has one. Its anchor is the folder's and the file's name.
  grid(file: string, options: GridOptions = {}): HTMLElement {
    this.shown.add(file);
    return file_grid(this.table(file), {
      ...options,
      file,
      folder: this.results.folder,
      anchor: this.anchor_of(file),
    });
  }

  anchor_of(file: string): string {
    return `${this.anchor}-${file.replace(/\.csv$/, "").replaceAll("_", "-")}`;
  }

  // These files have been shown by no part of the page yet.
  rest(): string[] {
    return this.files.filter((file) => !this.shown.has(file));
  }

  // A fact is an entry of machine.csv.
  fact(name: string): string {
    return (
      this.rows("machine.csv")
        .find((row) => row.text("name") === name)
        ?.text("value") ?? ""
    );
  }

  // Each scene has a name and a hash.
  scenes(): [string, string][] {
    const listed = this.rows("machine.csv")
      .filter((row) => row.text("name").startsWith("scene "))
      .map((row): [string, string] => [row.text("name").slice("scene ".length), row.text("value")]);
    const one = this.fact("scene_hash");
    return one ? [...listed, [this.fact("scene"), one]] : listed;
  }

  case_anchor(place: number): string {
    return `${this.anchor}-pair-${place}`;
  }

  // This is the address of the first pair of a case file. The path may start anywhere above the folder.
  case_of_file(path: string): string | undefined {
    if (!path) return undefined;
    const place = this.place_of(
      (source) => source !== "" && (path === source || path.endsWith(`/${source}`)),
    );
    return place < 0 ? undefined : this.case_anchor(place);
  }

  // This is the address of the first pair that a check or a sweep keeps of an algorithm.
  case_of_algorithm(algorithm: string, scalar: string, task = ""): string | undefined {
    const name = `failures/${[algorithm, scalar, task].filter(Boolean).join("-")}`;
    const place = this.place_of(
      (source) => source.startsWith(`${name}-`) || source === `${name}.jsonl`,
    );
    return place < 0 ? undefined : this.case_anchor(place);
  }

  private place_of(is_meant: (source: string) => boolean): number {
    return this.pairs.findIndex(({ sources }) => sources.some(is_meant));
  }
}
