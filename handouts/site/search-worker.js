// Search runs in a web worker, which browsers refuse to pages that are opened from a folder.
// There, a hidden frame does the worker's job.

class FrameWorker extends EventTarget {
  constructor(url) {
    super();
    this.frame = document.createElement("iframe");
    this.frame.hidden = true;
    document.body.append(this.frame);
    const inside = this.frame.contentWindow;
    this.listen = (event) => {
      if (event.source === inside) {
        const message = new MessageEvent("message", { data: event.data });
        this.dispatchEvent(message);
        this.onmessage?.(message);
      }
    };
    window.addEventListener("message", this.listen);
    inside.document.open();
    inside.document.write(
      `<body><script>(${likeWorker})()</` + `script><script src="${url}"></` + `script></body>`,
    );
    inside.document.close();
    this.ready = new Promise((resolve) => (inside.onload = resolve));
  }

  postMessage(data) {
    this.ready.then(() => {
      const inside = this.frame.contentWindow;
      inside.dispatchEvent(new MessageEvent("message", { data: structuredClone(data) }));
    });
  }

  terminate() {
    window.removeEventListener("message", this.listen);
    this.frame.remove();
  }
}

// What a worker's script expects to find. It runs in the frame.
function likeWorker() {
  window.postMessage = (data) => parent.postMessage(data, "*");
  window.importScripts = async (...urls) => {
    for (const url of urls) {
      await new Promise((resolve) => {
        const script = document.createElement("script");
        script.src = url;
        script.onload = resolve;
        document.body.append(script);
      });
    }
  };
}

if (location.protocol === "file:") {
  window.Worker = FrameWorker;
}
