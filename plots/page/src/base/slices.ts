// Long work is done in slices: between two of them the browser draws, and answers the reader.

const milliseconds_of_a_slice = 10;

// Messages come after what the browser has to do, and are not held back as timers are. One channel serves all that
// wait: a channel of each one's own could be collected before its message comes.
let channel: MessageChannel | undefined;
const waiting: (() => void)[] = [];

const next_task = (): Promise<void> =>
  new Promise((resolve) => {
    if (!channel) {
      channel = new MessageChannel();
      channel.port1.onmessage = () => waiting.shift()!();
    }
    waiting.push(resolve);
    channel.port2.postMessage(null);
  });

export class Slices {
  private what = "";
  private end = performance.now() + milliseconds_of_a_slice;

  // `told` gets a text each time that the work rests. The signal gives the work up: it then throws where it rests.
  constructor(
    private readonly told: (progress: string) => void = () => {},
    private readonly signal?: AbortSignal,
  ) {}

  // A part of the work begins, in a slice of its own.
  async begin(what: string): Promise<void> {
    this.what = what;
    await this.next(what);
  }

  // Work calls this wherever it can be interrupted. `done` of `all` says how far its part is.
  async rest(done = 0, all = 0): Promise<void> {
    if (performance.now() < this.end) return;
    await this.next(all > 0 ? `${this.what}, ${Math.floor((100 * done) / all)} %` : this.what);
  }

  private async next(progress: string): Promise<void> {
    this.told(progress);
    await next_task();
    this.signal?.throwIfAborted();
    this.end = performance.now() + milliseconds_of_a_slice;
  }
}
